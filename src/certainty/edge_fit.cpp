#include "certainty/edge_fit.h"

#include <cmath>

#include "base/sigmoid.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr int kMostSteps = 40;
constexpr int kMostHalvings = 10;
constexpr double kAtRest = 1e-9;  // of the misfit

/// Minus twice the log posterior density; `weight` is K^-1 correction.
double misfit(const EdgeData& data, const ProfilePrior& prior, const ProfileParameters& profile,
              const Eigen::VectorXd& correction, const Eigen::VectorXd& weight) {
  double sum = correction.dot(weight) +
               ((profile - prior.mean).array().square() / prior.variance.array()).sum();
  for (Eigen::Index i = 0; i < data.reading.size(); ++i) {
    const double residual =
        data.reading[i] - profile_reading(profile, data.part[i], data.depth_m[i] + correction[i]);
    sum += residual * residual / data.variance[i];
  }
  return sum;
}

}  // namespace

double profile_share(const ProfileParameters& profile, double depth_m) {
  return sigmoid(std::exp(profile[2]) * depth_m);
}

double profile_contrast(const ProfileParameters& profile, int part) {
  return profile[1] - profile[0] + (part > 0 ? profile[kCommonParameters + part - 1] : 0.0);
}

double profile_reading(const ProfileParameters& profile, int part, double depth_m) {
  return profile[0] + profile_contrast(profile, part) * profile_share(profile, depth_m);
}

ReadingSlopes profile_slopes(const ProfileParameters& profile, int part, double depth_m) {
  const double share = profile_share(profile, depth_m);
  const double rise = share * (1.0 - share) * profile_contrast(profile, part);
  const double slope = std::exp(profile[2]);
  ReadingSlopes slopes{rise * slope, ProfileParameters::Zero(profile.size())};
  slopes.by_profile.head<kCommonParameters>() << 1.0 - share, share, rise * slope * depth_m;
  if (part > 0) slopes.by_profile[kCommonParameters + part - 1] = share;
  return slopes;
}

EdgeFit fit_edge_belief(const EdgeData& data, const Eigen::MatrixXd& prior_covariance,
                        const ProfilePrior& prior) {
  const Eigen::Index count = data.reading.size();
  EdgeFit fit{.profile = prior.mean,
              .correction_m = Eigen::VectorXd::Zero(count),
              .by_depth = Eigen::VectorXd(count),
              .by_profile = ProfileSlopes(count, prior.mean.size()),
              .pull = {},
              .covariance = {},
              .log_evidence = 0.0};
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(count);
  double here = misfit(data, prior, fit.profile, fit.correction_m, weight);
  for (int step = 0;; ++step) {
    Eigen::VectorXd linearized(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const double depth = data.depth_m[i] + fit.correction_m[i];
      const ReadingSlopes slopes = profile_slopes(fit.profile, data.part[i], depth);
      fit.by_depth[i] = prior_covariance(i, i) > 0.0 ? slopes.by_depth : 0.0;
      fit.by_profile.row(i) = slopes.by_profile;
      linearized[i] = data.reading[i] - profile_reading(fit.profile, data.part[i], depth) +
                      fit.by_depth[i] * fit.correction_m[i] +
                      slopes.by_profile.dot(fit.profile - prior.mean);
    }
    Eigen::MatrixXd covariance =
        fit.by_depth.asDiagonal() * prior_covariance * fit.by_depth.asDiagonal();
    covariance += fit.by_profile * prior.variance.asDiagonal() * fit.by_profile.transpose();
    covariance.diagonal() += data.variance;
    fit.covariance.compute(covariance);
    if (fit.covariance.info() != Eigen::Success || !covariance.allFinite())
      throw NumericalError("EdgeBelief: the covariance of " + std::to_string(count) +
                           " readings is not positive definite");
    fit.pull = fit.covariance.solve(linearized);
    fit.log_evidence =
        -0.5 * linearized.dot(fit.pull) - fit.covariance.matrixLLT().diagonal().array().log().sum();
    if (step == kMostSteps) return fit;

    const Eigen::VectorXd to_weight = fit.by_depth.cwiseProduct(fit.pull) - weight;
    const Eigen::VectorXd to_correction =
        prior_covariance * (weight + to_weight) - fit.correction_m;
    const ProfileParameters to_profile =
        prior.mean +
        ProfileParameters(prior.variance.asDiagonal() * (fit.by_profile.transpose() * fit.pull)) -
        fit.profile;
    double part = 1.0, there = here;
    for (int halving = 0; halving < kMostHalvings; ++halving, part *= 0.5) {
      there = misfit(data, prior, fit.profile + part * to_profile,
                     fit.correction_m + part * to_correction, weight + part * to_weight);
      if (there < here) break;
    }
    if (!(there < here)) return fit;
    fit.profile += part * to_profile;
    fit.correction_m += part * to_correction;
    weight += part * to_weight;
    // One more linearization, so that the covariance is that of the place of rest.
    if (here - there <= kAtRest * here) step = kMostSteps - 1;
    here = there;
  }
}

}  // namespace palpation
