/// The likelihood of one hyperparameter after another, given the readings of the same sites: what
/// does not depend on them is kept, and the memory for the rest.
#pragma once

#include <Eigen/Core>
#include <span>

#include "base/positive_definite.h"
#include "belief/pair_correlations.h"
#include "belief/sites.h"
#include "palpation/belief/hyperparameters.h"

namespace palpation {

/// Log likelihood as Belief::log_marginal_likelihood has it, and its gradient by the logarithms of
/// length, signal and noise: what `learn` climbs.
struct LikelihoodGradient {
  double value = 0.0;
  Vec3 gradient = Vec3::Zero();
};

class Likelihood {
 public:
  /// Keeps a reference to the prior, and to the sites.
  Likelihood(const Prior& prior, std::span<const Site> sites);

  /// likelihood_gradient of the same prior and sites.
  LikelihoodGradient operator()(const Hyperparameters& at);

 private:
  void merge_readings(double noise_variance, LikelihoodGradient& result);
  double integrate_constant_out();
  double integrate_slope_out();

  const Prior& prior_;
  std::span<const Site> sites_;
  PairCorrelations correlations_;
  PositiveDefiniteInverse inverse_;
  Eigen::MatrixXd p_;  // the lower half
  Eigen::VectorXd readings_, variances_, variance_slopes_, mean_slopes_;
};

LikelihoodGradient likelihood_gradient(const Prior& prior, std::span<const Site> sites,
                                       const Hyperparameters& at);

/// Its value alone, at a fifth of the cost.
double log_likelihood(const Prior& prior, std::span<const Site> sites, const Hyperparameters& at);

}  // namespace palpation
