#include "exploration/likelier_scale.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "certainty/outline_evidence.h"
#include "exploration/find_boundary.h"
#include "exploration/soft_spot.h"
#include "palpation/base/error.h"
#include "palpation/certainty/misfit.h"
#include "readings/readings.h"

namespace palpation {
namespace {

/// Half of the way from 1 to that is within a tenth of it the same on either scale.
constexpr double kSkewed = 2.0;
/// Of so many readings at most one has no logarithm: contact that was lost, a fault.
constexpr std::size_t kOneInWithout = 20;
/// Of readings that tell nothing, beforehand; over so many times the range of the others.
constexpr double kWild = 0.01, kWildRange = 3.0;
/// By odds of a thousand to one: walks of outlines know them to a half of that.
const double kRuledOut = std::log(1000.0);

/// Whether some readings of a session are so many times as high as others of it, and nearly all
/// are positive.
bool are_skewed(std::span<const Palpation> felt) {
  std::map<int, std::pair<double, double>> ranges;  // least and greatest of each session
  std::size_t count = 0, without_logarithm = 0;
  for (const Palpation& one : felt) {
    if (!counts(one)) continue;
    ++count;
    if (!(one.reading > 0.0)) {
      ++without_logarithm;
      continue;
    }
    auto& [least, greatest] =
        ranges.try_emplace(one.session, one.reading, one.reading).first->second;
    least = std::min(least, one.reading);
    greatest = std::max(greatest, one.reading);
  }
  return kOneInWithout * without_logarithm <= count &&
         std::ranges::any_of(ranges, [](const auto& session) {
           const auto& [least, greatest] = session.second;
           return greatest >= kSkewed * least;
         });
}

/// Values in the readings' unit have no meaning beside logarithms.
bool is_open(const Model& model) {
  const FieldModel& field = model.field;
  return !model.contrast.scale && !model.contrast.least && model.level.is_of_edge() &&
         field.kernel.signal_sd.is_learned() && field.noise.sd.is_learned();
}

KnownOnScale known_on(ReadingScale scale, const Surface& surface, const Model& model,
                      const std::vector<Palpation>& felt, ConclusionCache& cache, bool is_last) {
  std::vector<Palpation> scaled = on_scale(scale, felt);
  Known known = known_beside_soft_spot(surface, on_scale(scale, model), scaled, cache, is_last);
  return {scale, std::move(scaled), std::move(known)};
}

/// Of one that tells on that scale, on average; nothing where no outline is found.
std::optional<double> log_density_of_one(const KnownOnScale& on, const Model& model,
                                         std::optional<std::uint64_t> sampling_seed) {
  const Believed& believed = on.known.believed;
  const EdgeBelief& edge = *on.known.boundary.edge;
  if (!sampling_seed) return edge.log_evidence() / believed.belief.site_count();
  const std::optional<OutlineEvidence> by_outlines =
      outline_evidence(believed.belief, edge, outline_options(model, believed, *sampling_seed));
  if (!by_outlines) return std::nullopt;
  return by_outlines->log_density / static_cast<double>(by_outlines->readings);
}

/// Nats, of readings as the sensor makes them. What is set aside on a scale may be anything there.
class DensityOfReadings {
 public:
  DensityOfReadings(std::span<const Palpation> felt, const KnownOnScale& raw) : felt_(felt) {
    const std::vector<double> used = used_readings(raw.known.believed.palpations);
    const auto [least, greatest] = std::ranges::minmax(used);
    wild_ = std::log(kWild / (kWildRange * (greatest - least)));
  }

  double of(const KnownOnScale& on, double log_density_of_one) const {
    const std::vector<Palpation>& used = on.known.believed.palpations;
    double sum = 0.0;
    for (std::size_t i = 0; i < felt_.size(); ++i) {
      if (!counts(felt_[i])) continue;
      sum += counts(used[i]) ? log_density_of_one : wild_;
      if (counts(used[i]) && on.scale == ReadingScale::Log) sum -= std::log(felt_[i].reading);
    }
    return sum;
  }

 private:
  std::span<const Palpation> felt_;
  double wild_ = 0.0;
};

/// By how much logarithms are more probable, nats; nothing where outlines do not tell.
std::optional<double> gained_by(const KnownOnScale& log, const KnownOnScale& raw,
                                std::span<const Palpation> felt, const Model& model,
                                std::optional<std::uint64_t> sampling_seed) {
  const std::optional<double> one_by_log = log_density_of_one(log, model, sampling_seed),
                              one_by_raw = log_density_of_one(raw, model, sampling_seed);
  if (!one_by_log || !one_by_raw) return std::nullopt;
  const DensityOfReadings density(felt, raw);
  return density.of(log, *one_by_log) - density.of(raw, *one_by_raw);
}

}  // namespace

Model on_scale(ReadingScale scale, Model model) {
  if (model.level.known) {
    require(scale == ReadingScale::Raw || *model.level.known > 0.0, "Model",
            "level = " + text_of(*model.level.known),
            "must be positive where readings are taken by their logarithm");
    model.level.known = on_scale(scale, *model.level.known);
  }
  return model;
}

LikelierScale on_likelier_scale(const Surface& surface, const Model& model,
                                const std::vector<Palpation>& felt, ConclusionCache& cache,
                                std::optional<std::uint64_t> sampling_seed) {
  const bool is_last = sampling_seed.has_value();
  KnownOnScale one = known_on(model.contrast.scale.value_or(ReadingScale::Raw), surface, model,
                              felt, cache, is_last);
  if (!is_open(model) || !are_skewed(felt) || !one.known.boundary.edge) return {std::move(one)};
  ConclusionCache apart;  // beliefs on another scale do not grow from those on this one
  apart.remember_tried_by(cache);
  KnownOnScale log = known_on(ReadingScale::Log, surface, model, felt, apart, is_last);
  cache.remember_tried_by(apart);
  if (!log.known.boundary.edge) return {std::move(one)};
  const std::optional<double> gained = gained_by(log, one, felt, model, sampling_seed);
  const double clearly = is_last ? kRuledOut : surprising();
  if (!gained || *gained < (is_last ? -clearly : clearly)) return {std::move(one)};
  if (*gained > clearly) return {std::move(log)};
  if (*gained > 0.0) std::swap(one, log);
  return {std::move(one), std::move(log)};
}

}  // namespace palpation
