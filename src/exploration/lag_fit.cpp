#include "exploration/lag_fit.h"

#include <cmath>

namespace palpation {
namespace {

constexpr int kMostRounds = 5;
constexpr double kAtRest_m = 0.00002;  // a fifth of what two lags can be told apart by

FieldFit fit_at(const Surface& surface, const FieldModel& field, std::span<const Palpation> palpations, const Hyperparameters& start,
                double lag_m) {
  const std::vector<Palpation> moved = displaced(surface, palpations, lag_m);
  if (field.learns()) return fit_field(surface, field, moved, start);
  return {fixed_field(surface, field, moved), start};
}

Hyperparameters in_force(const Belief& belief) {
  return {belief.prior().kernel().length_m, belief.signal_sd(), std::sqrt(belief.noise_variance())};
}

/// The field's prior about a constant that is not known: where readings belong does not depend on what they have in common.
Prior for_lag(const Belief& belief) {
  const Prior& prior = belief.prior();
  if (std::isinf(prior.constant().sd)) return prior;
  return Prior(prior.surface(), prior.metric(), prior.kernel(), {}, prior.slope());
}

}  // namespace

LagFit fit_lagged(const Surface& surface, const FieldModel& field, std::span<const Palpation> palpations, const Hyperparameters& start,
                  const std::optional<Lag>& before) {
  if (!field.lag.learn) return {fit_at(surface, field, palpations, start, field.lag.known_m), Lag{field.lag.known_m, 0.0}};
  double lag_m = before ? before->value_m : LagPrior{}.mean_m;
  LagFit fit{fit_at(surface, field, palpations, start, lag_m)};
  for (int round = 0; round < kMostRounds; ++round) {
    fit.lag = learn_lag(for_lag(fit.field.belief), palpations, in_force(fit.field.belief));
    if (!fit.lag || std::abs(fit.lag->value_m - lag_m) <= kAtRest_m) break;
    lag_m = fit.lag->value_m;
    fit.field = fit_at(surface, field, palpations, fit.field.learned, lag_m);
  }
  return fit;
}

}  // namespace palpation
