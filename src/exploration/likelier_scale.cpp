#include "exploration/likelier_scale.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "certainty/edge_data.h"
#include "exploration/as_if_unchanged.h"
#include "exploration/comparable_evidence.h"
#include "readings/readings.h"

namespace palpation {
namespace {

/// Of readings that count, by an edge on a scale.
struct Told {
  double log_evidence = 0.0;  ///< of the rows as the sensor reads them
  double noise_variance = 0.0;
  std::size_t count = 0;  ///< of readings
};

/// How much denser the rows' logarithms are than the rows.
double log_density_of_logarithms(const Belief& belief, std::span<const Palpation> felt) {
  double sum = 0.0;
  for (const std::vector<Made>& made : gathered_for_edge(belief).made) {
    for (const Made& one : made)
      sum += std::log(felt[one.number].reading) / static_cast<double>(made.size());
  }
  return sum;
}

/// `noise_variance`: that of readings as they are, where it is known.
std::optional<Told> told_on(ReadingScale scale, const Surface& surface, const Model& model,
                            const std::vector<Palpation>& felt, ConclusionCache& cache,
                            std::optional<double> noise_variance = std::nullopt) {
  ConclusionCache apart;  // beliefs on another scale do not grow from those on this one
  apart.remember_tried_by(cache);
  const Known known =
      known_as_if_unchanged(surface, model, on_scale(scale, felt), apart, /*is_last=*/false);
  cache.remember_tried_by(apart);
  if (!known.boundary.edge) return std::nullopt;
  const Belief& belief = known.believed.belief;
  Told told{.noise_variance = noise_variance.value_or(belief.noise_variance())};
  told.log_evidence = comparable_evidence(known.boundary.edge, belief, told.noise_variance);
  told.count = static_cast<std::size_t>(std::ranges::count_if(known.believed.palpations, counts));
  if (scale == ReadingScale::Log) told.log_evidence -= log_density_of_logarithms(belief, felt);
  return told;
}

}  // namespace

ReadingScale likelier_scale(const Surface& surface, const Model& model,
                            const std::vector<Palpation>& felt, ConclusionCache& cache) {
  const auto is_positive = [](const Palpation& one) { return !counts(one) || one.reading > 0.0; };
  if (!std::ranges::all_of(felt, is_positive)) return ReadingScale::Raw;
  const std::optional<Told> raw = told_on(ReadingScale::Raw, surface, model, felt, cache),
                            log = raw ? told_on(ReadingScale::Log, surface, model, felt, cache,
                                                raw->noise_variance)
                                      : raw;
  const bool prefers_log = raw && log && raw->count == log->count &&
                           log->log_evidence > raw->log_evidence + surprising();
  return prefers_log ? ReadingScale::Log : ReadingScale::Raw;
}

}  // namespace palpation
