#include "exploration/lag_fit.h"

#include <cmath>
#include <utility>
#include <vector>

#include "readings/way.h"

namespace palpation {
namespace {

constexpr int kMostRounds = 5;
constexpr double kAtRest_m = 0.00002;  // a fifth of what two lags can be told apart by

/// The field's prior about a constant that is not known: where readings belong does not depend on
/// what they have in common.
Prior for_lag(const Prior& prior) {
  if (std::isinf(prior.constant().sd)) return prior;
  return prior.with(prior.kernel(), {}, prior.slope());
}

/// Those of a field, in reading units.
Hyperparameters in_force(const Belief& belief) {
  return {belief.prior().kernel().length_m, belief.signal_sd(), std::sqrt(belief.noise_variance())};
}

/// The field of fixed hyperparameters.
LearnedField as_given(const Surface& surface, const FieldModel& field,
                      std::span<const Palpation> palpations) {
  const Belief belief = fixed_field(surface, field, palpations);
  return {Belief(belief.prior(), belief.options()), in_force(belief), 0.0, true};
}

/// An outline follows the rows of a raster one by one, each as late as it is, and to first order an
/// edge knows of no lag that is far.
bool may_come_late(const EdgeBelief& edge, const Belief& belief) {
  if (follow_closely(belief.prior().surface(), belief.palpations())) return true;
  const std::optional<Misfit> hint = edge.lag();
  return hint && hint->evidence > 0.0;
}

LearnedField learned_at(const Surface& surface, const FieldModel& field,
                        std::span<const Palpation> palpations, const Hyperparameters& start,
                        double lag_m) {
  const std::vector<Palpation> moved = displaced(surface, palpations, lag_m);
  return field.learns() ? learn_field(surface, field, moved, start)
                        : as_given(surface, field, moved);
}

}  // namespace

LagFit fit_lagged(const Surface& surface, const FieldModel& field,
                  std::span<const Palpation> palpations) {
  const bool learns_lag = field.probe.lag_m.is_learned();
  double lag_m = field.probe.lag_m.value_or(LagPrior{}.mean_m);
  std::optional<Lag> lag = Lag{.value_m = field.probe.lag_m.value_or(0.0)};
  LearnedField taught = learned_at(surface, field, palpations, {}, lag_m);
  for (int round = 0; learns_lag && round < kMostRounds; ++round) {
    lag = learn_lag(for_lag(taught.blank.prior()), palpations, taught.in_force());
    if (!lag || std::abs(lag->value_m - lag_m) <= kAtRest_m) break;
    lag_m = lag->value_m;
    taught = learned_at(surface, field, palpations, taught.learned, lag_m);
  }
  return {belief_of(surface, field, displaced(surface, palpations, lag_m), taught), lag};
}

std::optional<Misfit> lag_seen(const FieldModel& field, const EdgeBelief& edge,
                               const Belief& belief) {
  if (field.probe.has_lag() || !(belief.noise_variance() > 0.0) || !may_come_late(edge, belief))
    return std::nullopt;
  LagPrior none_expected;
  none_expected.mean_m = 0.0;
  const std::optional<Lag> lag =
      learn_lag(for_lag(belief.prior()), belief.palpations(), in_force(belief), none_expected);
  if (!lag || !(lag->log_gain > surprising())) return std::nullopt;
  return Misfit{.kind = MisfitKind::Late, .evidence = lag->log_gain, .amount = lag->value_m};
}

}  // namespace palpation
