#include "palpation/certainty/edge_profile.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/sigmoid.h"
#include "certainty/depth.h"
#include "palpation/base/error.h"
#include "palpation/certainty/level_estimate.h"

namespace palpation {
namespace {

constexpr int kMostSteps = 200;
constexpr int kMostRounds = 8;
/// The level rests when it moves by less than this part of its standard deviation.
constexpr double kAtRest = 0.02;

/// low, high, log slope, shift.
using Parameters = Eigen::Vector4d;

/// Residuals over their standard deviations, the prior's four last, and their derivatives.
struct Residuals {
  Eigen::VectorXd value;
  Eigen::Matrix<double, Eigen::Dynamic, 4> slope;
};

Residuals residuals(std::span<const EdgeReading> readings, const EdgePrior& prior,
                    const Parameters& at) {
  const auto count = static_cast<Eigen::Index>(readings.size());
  Residuals made{Eigen::VectorXd(count + 4),
                 Eigen::Matrix<double, Eigen::Dynamic, 4>::Zero(count + 4, 4)};
  const double slope = std::exp(at[2]);
  for (Eigen::Index i = 0; i < count; ++i) {
    const EdgeReading& reading = readings[static_cast<std::size_t>(i)];
    const double depth = slope * (reading.depth_m + at[3]);
    const double share = sigmoid(depth);
    const double rise = share * (1.0 - share) * (at[1] - at[0]);
    const double sd = std::sqrt(reading.variance);
    made.value[i] = (at[0] + share * (at[1] - at[0]) - reading.reading) / sd;
    made.slope.row(i) << (1.0 - share) / sd, share / sd, rise * depth / sd, rise * slope / sd;
  }
  const Eigen::Vector4d centre(prior.plateau, prior.plateau, std::log(prior.slope_per_m), 0.0);
  const Eigen::Vector4d width(prior.plateau_sd, prior.plateau_sd, prior.slope_log_sd,
                              prior.shift_sd_m);
  made.value.tail<4>() = (at - centre).cwiseQuotient(width);
  made.slope.bottomRows<4>().diagonal() = width.cwiseInverse();
  return made;
}

void check(std::span<const EdgeReading> readings, double fraction, const EdgePrior& prior) {
  require(!readings.empty(), "fit_edge", "no reading", "tells no profile: at least one is needed");
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const EdgeReading& reading = readings[i];
    require(std::isfinite(reading.depth_m) && std::isfinite(reading.reading), "fit_edge",
            "reading " + std::to_string(i), "must be finite");
    require(std::isfinite(reading.variance) && reading.variance > 0.0, "fit_edge",
            "the variance " + text_of(reading.variance) + " of reading " + std::to_string(i),
            "must be positive and finite");
  }
  require(fraction > 0.0 && fraction < 1.0, "fit_edge", "fraction = " + text_of(fraction),
          "must lie in (0, 1)");
  for (const double width :
       {prior.slope_per_m, prior.slope_log_sd, prior.shift_sd_m, prior.plateau_sd}) {
    require(std::isfinite(width) && width > 0.0, "fit_edge", "the prior's " + text_of(width),
            "must be positive and finite");
  }
}

/// Plateaus to start from: the means of the readings inside and outside, of the prior where there
/// are none.
Parameters start(std::span<const EdgeReading> readings, const EdgePrior& prior) {
  double low = 0.0, high = 0.0, outside = 0.0, inside = 0.0;
  for (const EdgeReading& reading : readings) {
    (reading.depth_m >= 0.0 ? high : low) += reading.reading;
    (reading.depth_m >= 0.0 ? inside : outside) += 1.0;
  }
  return {outside > 0.0 ? low / outside : prior.plateau,
          inside > 0.0 ? high / inside : prior.plateau, std::log(prior.slope_per_m), 0.0};
}

struct Fit {
  Parameters at;
  double misfit;              ///< sum of the squared residuals, the prior's included
  Eigen::Matrix4d curvature;  ///< of half the misfit (Gauss and Newton's)
};

/// Levenberg and Marquardt's steps, damped by the curvature's diagonal.
Fit most_probable(std::span<const EdgeReading> readings, const EdgePrior& prior,
                  const Parameters& from) {
  Fit fit{from, 0.0, Eigen::Matrix4d::Zero()};
  Residuals here = residuals(readings, prior, fit.at);
  fit.misfit = here.value.squaredNorm();
  double damping = 1e-3;
  for (int step = 0; step < kMostSteps && damping < 1e12; ++step) {
    const Eigen::Matrix4d curvature = here.slope.transpose() * here.slope;
    const Eigen::Vector4d downhill = -here.slope.transpose() * here.value;
    Eigen::Matrix4d damped = curvature;
    damped.diagonal() *= 1.0 + damping;
    const Parameters next = fit.at + damped.llt().solve(downhill);
    Residuals there = residuals(readings, prior, next);
    const double misfit = there.value.squaredNorm();
    if (!(misfit < fit.misfit)) {
      damping *= 8.0;
      continue;
    }
    const bool at_rest = fit.misfit - misfit <= 1e-10 * fit.misfit;
    fit.at = next;
    fit.misfit = misfit;
    here = std::move(there);
    damping *= 0.2;
    if (at_rest) break;
  }
  fit.curvature = here.slope.transpose() * here.slope;
  return fit;
}

}  // namespace

double share_at_depth(const EdgeProfile& profile, double depth_m) {
  return sigmoid(profile.slope_per_m * (depth_m + profile.shift_m));
}

EdgeProfile fit_edge(std::span<const EdgeReading> readings, double fraction,
                     const EdgePrior& prior) {
  check(readings, fraction, prior);
  const Fit fit = most_probable(readings, prior, start(readings, prior));
  if (!fit.at.allFinite())
    throw NumericalError("fit_edge: the profile's parameters are not finite");
  EdgeProfile profile{.low = fit.at[0],
                      .high = fit.at[1],
                      .slope_per_m = std::exp(fit.at[2]),
                      .shift_m = fit.at[3],
                      .level = {}};
  const Eigen::Vector4d of_level(1.0 - fraction, fraction, 0.0, 0.0);
  // Readings that scatter more than their variances say are believed that much less.
  const double scatter = std::max(1.0, fit.misfit / static_cast<double>(readings.size()));
  profile.level = {profile.low + fraction * (profile.high - profile.low),
                   std::sqrt(scatter * of_level.dot(fit.curvature.llt().solve(of_level)))};
  return profile;
}

Level level_from_edge(const Surface& surface, const Belief& belief, const Marginals& marginals,
                      double fraction) {
  Level level = level_from_range(marginals, fraction);
  const double range = marginals.mean.maxCoeff() - marginals.mean.minCoeff();
  level.stddev = 0.5 * range;
  const Layout layout(belief.prior());
  std::vector<EdgeReading> readings;
  std::vector<SurfacePoint> points;
  std::vector<Vec3> places;
  for (const Palpation& palpation : belief.detrended_palpations()) {
    if (!palpation.set_aside.empty()) continue;
    readings.push_back({0.0, palpation.reading,
                        std::isnan(palpation.noise_variance) ? belief.noise_variance()
                                                             : palpation.noise_variance});
    points.push_back(palpation.where);
    places.push_back(layout.at(palpation.where));
  }
  if (readings.empty() || !(range > 0.0)) return level;
  // Readings without noise still scatter about the profile: as much as the model of the edge is
  // wrong, a hundredth of the range.
  for (EdgeReading& reading : readings)
    reading.variance = std::max(reading.variance, 1e-4 * range * range);
  const Eigen::VectorXd mean = belief.at(points, Part::Detrended).mean;
  const EdgePrior prior{.plateau = 0.5 * (marginals.mean.maxCoeff() + marginals.mean.minCoeff()),
                        .plateau_sd = range};
  for (int round = 0; round < kMostRounds; ++round) {
    const std::vector<double> distances =
        distances_from(layout, level_loops(surface, marginals.mean, level.value), places);
    if (distances.empty()) return level;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      readings[i].depth_m =
          mean[static_cast<Eigen::Index>(i)] >= level.value ? distances[i] : -distances[i];
    }
    const Level next = fit_edge(readings, fraction, prior).level;
    const double moved = std::abs(next.value - level.value);
    level = next;
    if (moved <= kAtRest * *level.stddev) break;
  }
  return level;
}

}  // namespace palpation
