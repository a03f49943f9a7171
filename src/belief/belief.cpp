#include "palpation/belief/belief.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "belief/belief_state.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

/// Takes the last `more` palpations in by their features. False where the exact engine is to take
/// all of them; `next` then has none.
bool reduce(BeliefState& next, std::size_t more) {
  const ScaledPrior& field = next.field;
  if (field.options.reduced_rank_tolerance == 0.0) return false;
  next.field.standardize(next.palpations);
  const std::size_t count = next.palpations.size();
  const std::shared_ptr<const ReducedEngine> before = std::exchange(next.reduced, nullptr);
  if (before) {
    next.reduced =
        before->with(field, gather_sites(field.prior, std::span(next.palpations).last(more)));
    if (next.reduced) return true;
  } else if (count < static_cast<std::size_t>(2 * next.reduction_tried_at) ||
             count < ReducedEngine::kFewSites) {
    return false;
  }
  const std::vector<Site> sites = gather_sites(field.prior, next.palpations);
  if (sites.size() < ReducedEngine::kFewSites || !ReducedEngine::are_noisy(field, sites))
    return false;
  next.reduction_tried_at = static_cast<int>(sites.size());
  const double origin =
      next.exact.row_count() == 0 ? field.origin(sites) : next.exact.whitened().origin;
  next.reduced = ReducedEngine::of(field, sites, origin, before ? before->features() : nullptr);
  return next.reduced != nullptr;
}

}  // namespace

Vec3 BeliefState::tilt_residual(int vertex, Part part) const {
  const Vec3 tilt = field.prior.tilt(field.prior.coordinates(vertex));
  return regression.tilt_residual(tilt, engine().tilts(field.prior.tiles(), vertex),
                                  residual_ones(vertex), part);
}

Belief::Belief(Prior prior, const BeliefOptions& options) {
  require(std::isfinite(options.noise_sd) && options.noise_sd >= 0.0, "Belief",
          "noise_sd = " + text_of(options.noise_sd), "must be finite and not negative");
  const double tolerance = options.reduced_rank_tolerance;
  require(tolerance == 0.0 || (tolerance >= 1e-13 && tolerance <= 1e-4), "Belief",
          "reduced_rank_tolerance = " + text_of(tolerance), "must be 0 or from 1e-13 to 1e-4");
  state_ = std::make_shared<const BeliefState>(BeliefState{{std::move(prior), options}});
}

const Prior& Belief::prior() const { return state_->field.prior; }
const BeliefOptions& Belief::options() const { return state_->field.options; }
const std::vector<Palpation>& Belief::palpations() const { return state_->palpations; }
int Belief::site_count() const { return state_->engine().site_count(); }
double Belief::noise_variance() const { return state_->field.noise_variance(); }
double Belief::signal_sd() const { return state_->field.signal_sd(); }

Belief Belief::condition_on(std::span<const Palpation> more) const {
  auto next = std::make_shared<BeliefState>(*state_);
  next->palpations.insert(next->palpations.end(), more.begin(), more.end());
  if (reduce(*next, more.size())) {
    next->exact = {};
  } else {
    const std::size_t fresh = state_->reduced ? next->palpations.size() : more.size();
    next->exact = state_->exact.after(next->field, next->palpations, fresh);
  }
  next->regression = Regression(next->field, next->engine().whitened());
  return Belief(std::move(next));
}

Belief Belief::foresee(std::span<const SurfacePoint> places) const {
  auto next = std::make_shared<BeliefState>(*state_);
  next->exact.forget_foreseen();
  const BeliefOptions& options = next->field.options;
  // The signal of standardized readings changes with every one: rows for it would be those of
  // another noise.
  const bool keeps_noise = !options.standardize || options.noise_is_relative;
  if (places.empty() || next->reduced || !keeps_noise) return Belief(std::move(next));
  // One value is like another here; the origin is that of the readings, if there are any.
  std::vector<Palpation> supposed(places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    supposed[i] = {.where = places[i], .reading = next->field.centre};
  const Belief touched = Belief(next).condition_on(supposed);
  if (!touched.state_->reduced)
    next->exact.foresee(touched.state_->exact, static_cast<int>(places.size()));
  return Belief(std::move(next));
}

std::optional<ReducedRank> Belief::reduced_rank() const {
  if (!state_->reduced) return std::nullopt;
  return state_->reduced->loss(state_->field, state_->regression,
                               at_vertices().variance.maxCoeff());
}

Vec3 Belief::slope() const { return prior().slope().sd.cwiseProduct(state_->regression.tilt()); }

std::vector<Palpation> Belief::detrended_palpations() const { return detrended(palpations()); }

std::vector<Palpation> Belief::detrended(std::vector<Palpation> palpations) const {
  if (!prior().has_slope()) return palpations;
  for (Palpation& palpation : palpations)
    palpation.reading -=
        state_->regression.tilt().dot(prior().tilt(prior().coordinates(palpation.where)));
  return palpations;
}

double Belief::log_marginal_likelihood() const {
  const ScaledPrior& field = state_->field;
  const Engine& engine = state_->engine();
  const int n = site_count();
  if (n == 0) return 0.0;
  const double signal_variance = field.signal_variance();
  const Evidence left = state_->regression.integrated_out(
      field, engine.whitened(), engine.plus_log_determinant(n * std::log(signal_variance)));
  const double result = -0.5 * (left.square / signal_variance + left.log_determinant +
                                (n + left.free_readings) * std::log(2.0 * std::numbers::pi));
  return engine.plus_scatter(result, field.noise_variance());
}

}  // namespace palpation
