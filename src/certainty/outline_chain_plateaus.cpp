// How a chain moves its outline whatever the plateaus are: a larger outline with a lower plateau
// explains readings that are far apart as well, and steps of either alone are short.
#include <Eigen/Cholesky>
#include <cmath>
#include <tuple>
#include <utility>

#include "certainty/outline_chain.h"

namespace palpation {

/// How far low and high are above their medians given all else, which is normal; and the readings'
/// log density without them.
struct OutlineChain::Plateaus {
  Eigen::LLT<Eigen::Matrix2d> precision;
  Eigen::Vector2d mean;
  double log_density = 0.0;
};

/// A reading is off low (1 - rise) + high rise; one where the sensor's range ended by as much
/// whatever they are.
OutlineChain::Plateaus OutlineChain::plateaus() const {
  const double low = prior_->median.low, high = prior_->median.high;
  Eigen::MatrixX3d columns(static_cast<Eigen::Index>(felt_.size()), 3);
  for (std::size_t i = 0; i < felt_.size(); ++i) {
    if (residuals_.is_bound(i)) {
      columns.row(static_cast<Eigen::Index>(i)) << 0.0, 0.0, residuals_.off(i);
      continue;
    }
    const double rise = law_.gain[epoch_of(i)] *
                        std::exp(profile_.log_contrast[part_of(felt_[i])]) *
                        share_of_contrast(felt_[i], law_);
    columns.row(static_cast<Eigen::Index>(i)) << 1.0 - rise, rise,
        readings_->reading[i] - low - (high - low) * rise;
  }
  const Eigen::Matrix3d products = residuals_.products(columns);
  Eigen::Matrix2d precision = products.topLeftCorner<2, 2>();
  const PlateauPrior& prior = prior_->plateaus;
  precision(0, 0) += 1.0 / (prior.low_sd * prior.low_sd);
  precision(1, 1) += 1.0 / (prior.high_sd * prior.high_sd);
  const Eigen::Vector2d pull = products.topRightCorner<2, 1>();
  Plateaus plateaus{.precision = precision.llt(), .mean = {}};
  plateaus.mean = plateaus.precision.solve(pull);
  plateaus.log_density = 0.5 * (pull.dot(plateaus.mean) - products(2, 2)) -
                         plateaus.precision.matrixLLT().diagonal().array().log().sum();
  return plateaus;
}

double OutlineChain::log_evidence() const { return plateaus().log_density; }

bool OutlineChain::move_whatever_plateaus(const std::vector<Vec2>& places, double log_slope,
                                          Random& random, double log_volume) {
  Plateaus drawn_from = plateaus();
  const double before = log_prior() + drawn_from.log_density;
  auto other = std::tuple(outline_, pieces_, profile_, law_, felt_, held_);
  const auto restore = [&] {
    std::tie(outline_, pieces_, profile_, law_, felt_, held_) = std::move(other);
  };
  outline_.place = places;
  bool taken = is_simple(outline_) && is_nested_as_before();
  if (taken) {
    pieces_ = OutlinePieces(outline_);
    profile_.log_slope = log_slope;
    law_ = law_of(profile_, *prior_);
    for (std::size_t i = 0; i < felt_.size(); ++i) felt_[i] = felt_anew(felt_[i].place);
    std::vector<int> held = held_in(felt_);
    const Plateaus then = plateaus();
    taken = may_hold(held) &&
            std::log(random.uniform()) < log_prior() + then.log_density - before + log_volume;
    if (taken) {
      drawn_from = then;
      held_ = std::move(held);
    }
  }
  if (!taken) restore();
  const std::pair was(profile_.low, profile_.high);
  const Eigen::Vector2d normal(random.normal(), random.normal());
  const Eigen::Vector2d drawn = drawn_from.mean + drawn_from.precision.matrixU().solve(normal);
  profile_.low = prior_->median.low + drawn[0];
  profile_.high = prior_->median.high + drawn[1];
  law_ = law_of(profile_, *prior_);
  residuals_.forget();
  for (std::size_t i = 0; i < felt_.size(); ++i)
    residuals_.consider(i, off_from(i, felt_[i], law_));
  if (residuals_.is_possible()) {
    residuals_.keep();
    return taken;
  }
  // Beyond the sensor's range, which such plateaus do not reach.
  residuals_.forget();
  if (taken) restore();
  std::tie(profile_.low, profile_.high) = was;
  law_ = law_of(profile_, *prior_);
  return false;
}

}  // namespace palpation
