#include "exploration/likelier_scale.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "exploration/as_if_unchanged.h"
#include "readings/readings.h"

namespace palpation {
namespace {

/// Of readings that count, in all their number, by an edge on a scale.
struct Told {
  double log_evidence = 0.0;  ///< of the readings as they were made
  std::size_t count = 0;
};

std::optional<Told> told_on(ReadingScale scale, const Surface& surface, const Model& model,
                            const std::vector<Palpation>& felt) {
  ConclusionCache cache;
  const Known known =
      known_as_if_unchanged(surface, model, on_scale(scale, felt), cache, /*is_last=*/false);
  if (!known.boundary.edge) return std::nullopt;
  Told told{.log_evidence = known.boundary.edge->log_evidence()};
  for (std::size_t i = 0; i < felt.size(); ++i) {
    if (!counts(known.believed.palpations[i])) continue;
    ++told.count;
    // A logarithm is so many times as dense as its reading.
    if (scale == ReadingScale::Log) told.log_evidence -= std::log(felt[i].reading);
  }
  return told;
}

}  // namespace

ReadingScale likelier_scale(const Surface& surface, const Model& model,
                            const std::vector<Palpation>& felt) {
  const auto is_positive = [](const Palpation& one) { return !counts(one) || one.reading > 0.0; };
  if (!std::ranges::all_of(felt, is_positive)) return ReadingScale::Raw;
  const std::optional<Told> raw = told_on(ReadingScale::Raw, surface, model, felt),
                            log = raw ? told_on(ReadingScale::Log, surface, model, felt) : raw;
  const bool prefers_log = raw && log && raw->count == log->count &&
                           log->log_evidence > raw->log_evidence + surprising();
  return prefers_log ? ReadingScale::Log : ReadingScale::Raw;
}

}  // namespace palpation
