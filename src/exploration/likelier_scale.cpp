#include "exploration/likelier_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "certainty/edge_data.h"
#include "certainty/outline_evidence.h"
#include "certainty/wild_readings.h"
#include "exploration/find_boundary.h"
#include "exploration/soft_spot.h"
#include "palpation/base/error.h"
#include "palpation/readings/screening.h"
#include "readings/readings.h"

namespace palpation {
namespace {

/// Half of the way from 1 to that is within a tenth of it the same on either scale.
constexpr double kSkewed = 2.0;
/// Of so many readings at most one has no logarithm: contact that was lost, a fault.
constexpr std::size_t kOneInWithout = 20;
/// By odds of a thousand to one: walks of outlines know them to a half of that.
const double kRuledOut = std::log(1000.0);
/// What a profile is off by, of the range, is no noise: taken for some, it would make even noise
/// that is less look like noise in proportion.
constexpr double kLeastError = 0.001;
const double kLogTwoPi = std::log(2.0 * std::numbers::pi);

/// Values in the readings' unit have no meaning beside logarithms.
bool is_open(const Model& model) {
  const FieldModel& field = model.field;
  return !model.contrast.scale && !model.contrast.least && model.level.is_of_edge() &&
         field.kernel.signal_sd.is_learned() && field.noise.sd.is_learned() &&
         field.trend.constant.sd == Constant{}.sd;
}

/// Whether some readings of a session are so many times as high as others of it, and nearly all
/// are positive, faults apart. Where the sensor's range ended they tell of no noise.
bool are_skewed(std::span<const Palpation> felt, std::span<const Palpation> used) {
  std::map<int, std::pair<double, double>> ranges;  // least and greatest of each session
  std::size_t count = 0, without_logarithm = 0;
  for (std::size_t i = 0; i < felt.size(); ++i) {
    const std::string& fault = used[i].set_aside;
    if (!counts(felt[i]) || fault == kNoContact || fault == kOutlier) continue;
    if (felt[i].is_bound()) return false;
    const double reading = felt[i].reading;
    ++count;
    if (!(reading > 0.0)) {
      ++without_logarithm;
      continue;
    }
    auto& [least, greatest] = ranges.try_emplace(felt[i].session, reading, reading).first->second;
    least = std::min(least, reading);
    greatest = std::max(greatest, reading);
  }
  return kOneInWithout * without_logarithm <= count &&
         std::ranges::any_of(ranges, [](const auto& session) {
           const auto& [least, greatest] = session.second;
           return greatest >= kSkewed * least;
         });
}

KnownOnScale known_on(ReadingScale scale, const Surface& surface, const Model& model,
                      const std::vector<Palpation>& felt, ConclusionCache& cache, bool is_last) {
  std::vector<Palpation> scaled = on_scale(scale, felt);
  Known known = known_beside_soft_spot(surface, on_scale(scale, model), scaled, cache, is_last);
  return {scale, std::move(scaled), std::move(known)};
}

/// Of the belief's rows, on its scale.
struct Told {
  double log_density = 0.0;  ///< nats
  std::vector<std::vector<Made>> rows{};
};

std::optional<Told> told_by_edge(const KnownOnScale& on, const Model& model) {
  const Belief& belief = on.known.believed.belief;
  const std::optional<EdgeBelief> edge =
      edge_around(model, belief, on.known.component, {on.known.boundary.edge->level().value},
                  {.profile_error = kLeastError});
  if (!edge) return std::nullopt;
  Told told{edge->log_evidence(), gathered_for_edge(belief).made};
  told.log_density -= 0.5 * kLogTwoPi * static_cast<double>(told.rows.size());
  return told;
}

std::optional<Told> told_by_outlines(const KnownOnScale& on, const Model& model,
                                     std::uint64_t seed) {
  const Believed& believed = on.known.believed;
  std::optional<OutlineEvidence> by_outlines =
      outline_evidence(believed.belief, *on.known.boundary.edge,
                       outline_options(model, believed, seed), kLeastError);
  if (!by_outlines) return std::nullopt;
  return Told{by_outlines->log_density, std::move(by_outlines->rows)};
}

/// How probable readings are as the sensor makes them, whatever scale they are told on.
class DensityAsRead {
 public:
  DensityAsRead(std::span<const Palpation> felt, const KnownOnScale& raw) : felt_(felt) {
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    for (std::size_t i = 0; i < felt.size(); ++i) {
      if (!counts(raw.known.believed.palpations[i])) continue;
      least = std::min(least, felt[i].reading);
      greatest = std::max(greatest, felt[i].reading);
    }
    log_wild_ = std::log(kWildPart / (kWildRanges * (greatest - least)));
    log_row_ = -0.5 * (kLogTwoPi + std::log(raw.known.believed.belief.noise_variance()) + 1.0);
  }

  /// Nats, over as many rows of noise alone. What is set aside on a scale may be anything.
  double of(const KnownOnScale& on, const Told& told) const {
    const Believed& believed = on.known.believed;
    double sum = told.log_density - log_row_ * static_cast<double>(told.rows.size());
    for (const std::vector<Made>& row : told.rows) {
      for (const Made& one : row)
        sum += log_stretch(on.scale, believed.evidence.taken_back, one) /
               static_cast<double>(row.size());
    }
    for (std::size_t i = 0; i < felt_.size(); ++i)
      sum += counts(felt_[i]) && !counts(believed.palpations[i]) ? log_wild_ - log_row_ : 0.0;
    return sum;
  }

 private:
  /// By how much what is told of a reading changes with it.
  double log_stretch(ReadingScale scale, const std::vector<Misfit>& taken_back,
                     const Made& one) const {
    double sum = scale == ReadingScale::Log ? -std::log(felt_[one.number].reading) : 0.0;
    for (const Misfit& change : taken_back) {
      if (change.kind == MisfitKind::Gain && is_since(change, one))
        sum -= std::log1p(change.amount);
    }
    return sum;
  }

  std::span<const Palpation> felt_;
  double log_wild_ = 0.0;
  double log_row_ = 0.0;
};

/// By how much logarithms are more probable, nats, if that is told on both scales.
template <typename ToldOn>
std::optional<double> gained_by(const ToldOn& told_on, const KnownOnScale& log,
                                const KnownOnScale& raw, std::span<const Palpation> felt) {
  const std::optional<Told> by_log = told_on(log), by_raw = told_on(raw);
  if (!by_log || !by_raw) return std::nullopt;
  const DensityAsRead density(felt, raw);
  return density.of(log, *by_log) - density.of(raw, *by_raw);
}

/// By an edge.
double gained_by_edge(const KnownOnScale& log, const KnownOnScale& raw, const Model& model,
                      std::span<const Palpation> felt) {
  return gained_by([&](const auto& on) { return told_by_edge(on, model); }, log, raw, felt)
      .value_or(0.0);
}

/// By an edge without a background in the logarithms, which would take seconds to search: most
/// readings are as they are, and ask again after each batch.
double gained_at_first(const Surface& surface, const Model& model, const KnownOnScale& raw,
                       const std::vector<Palpation>& felt, ConclusionCache& apart) {
  std::vector<Palpation> scaled = on_scale(ReadingScale::Log, felt);
  Known known = known_by(surface, model, believe(surface, model, scaled, apart));
  const KnownOnScale log{ReadingScale::Log, std::move(scaled), std::move(known)};
  constexpr double kAll = std::numeric_limits<double>::infinity();
  if (!log.known.boundary.edge) return -kAll;
  if (!raw.known.boundary.edge) return kAll;
  return gained_by_edge(log, raw, model, felt);
}

enum class Scales { Raw, Open, Log };

/// An edge is a sigmoid with even noise, and takes all else for noise. Outlines may be bent and
/// scatter more inside, but follow readings at the edge, the more the less noise those have: where
/// the two do not agree, it is open.
Scales scales_by(double by_edge, std::optional<double> by_outlines) {
  if (!by_outlines) return by_edge > surprising() ? Scales::Log : Scales::Raw;
  if (*by_outlines > kRuledOut && by_edge > 0.0) return Scales::Log;
  if (*by_outlines < -kRuledOut && by_edge < 0.0) return Scales::Raw;
  return Scales::Open;
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
  const auto known = [&](ReadingScale scale, ConclusionCache& grown) {
    return known_on(scale, surface, model, felt, grown, is_last);
  };
  if (!is_open(model)) return {known(model.contrast.scale.value_or(ReadingScale::Raw), cache)};
  KnownOnScale raw = known(ReadingScale::Raw, cache);
  if (!are_skewed(felt, raw.known.believed.palpations)) return {std::move(raw)};
  ConclusionCache apart;  // beliefs on another scale do not grow from those on this one
  apart.remember_tried_by(cache);
  if (gained_at_first(surface, model, raw, felt, apart) < (is_last ? -kRuledOut : surprising()))
    return {std::move(raw)};
  KnownOnScale log = known(ReadingScale::Log, apart);
  cache.remember_tried_by(apart);
  if (!log.known.boundary.edge) return {std::move(raw)};
  if (!is_last || !raw.known.boundary.edge) return {std::move(log)};
  const auto by_outlines = [&](const auto& on) {
    return told_by_outlines(on, model, *sampling_seed);
  };
  switch (
      scales_by(gained_by_edge(log, raw, model, felt), gained_by(by_outlines, log, raw, felt))) {
    case Scales::Log:
      return {std::move(log)};
    case Scales::Open:
      return {std::move(raw), std::move(log)};
    default:
      return {std::move(raw)};
  }
}

}  // namespace palpation
