// How sure a boundary is, all along: the offset's spread, and the band that holds all of it.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/normal.h"
#include "certainty/boundary_nodes.h"
#include "certainty/edge_belief_fit.h"

namespace palpation {
namespace {

/// The one recalibration: outlines have horns, corners and necks that normal offsets do not. The
/// outlines of 155 worlds, of 17 families, all of whose parts were found, lay whole within so many
/// of Rice's bands in 95 % (conformal; with each family left out in turn 94 % were held). Seeds and
/// commands: tests/sweeps/recalibrate.py. Sampled outlines do without.
constexpr double kRecalibration = 2.5;

/// Gauss and Hermite's five nodes for the mean over a standard normal variable.
constexpr std::array<std::pair<double, double>, 5> kNormalNodes = {
    {{-2.856970013872806, 0.011257411327720691},
     {-1.355626179974266, 0.22207592200561266},
     {0.0, 8.0 / 15.0},
     {1.355626179974266, 0.22207592200561266},
     {2.856970013872806, 0.011257411327720691}}};

/// Laplace's approximation takes the profile as straight; away from its middle readings tell less.
/// A sigmoid's squared slope is all but exp(-z^2 / 2) of its middle's, z = slope offset, so over
/// offsets of variance v a reading where the boundary is believed tells 1 / sqrt(1 + slope^2 v) of
/// that (the mean of the Hessian over the approximation itself: Opper and Archambeau 2009). Hence
/// v = straight sqrt(1 + slope^2 v), solved for v.
double variance_of_sigmoid(double straight, double slope_per_m) {
  const double part = straight * slope_per_m * slope_per_m;
  return 0.5 * straight * (part + std::sqrt(part * part + 4.0));
}

}  // namespace

/// Offsets at nodes along the boundary: how sure they are, and how they go together. Where the
/// boundary lies, the readings decide between the kinds of outline. How sure that is, they do not:
/// corners are few, and what most of an outline is like says little of the rest, so for that both
/// kinds of one explanation count alike.
void EdgeBelief::survey_boundary() {
  const BoundaryNodes nodes = boundary_nodes(surface_, depth_);
  const auto count = static_cast<Eigen::Index>(nodes.points.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count, count);
  for (const auto& fit : fits_) {
    Eigen::VectorXd off(count);
    for (Eigen::Index node = 0; node < count; ++node)
      off[node] = surface_.interpolate(fit->depth, nodes.points[node]);
    covariance += fit->alike * (fit->depth_covariance(nodes.points) + off * off.transpose());
  }
  const Eigen::VectorXd straight = covariance.diagonal().cwiseMax(0.0);
  const Eigen::VectorXd sd = straight.unaryExpr([&](double variance) {
    return std::sqrt(variance_of_sigmoid(variance, profile_.slope_per_m));
  });
  expected_error_m2_ = turn_ = 0.0;
  for (std::size_t i = 0; i < nodes.points.size(); ++i) {
    const auto here = static_cast<Eigen::Index>(i), before = here - 1;
    expected_error_m2_ += std::sqrt(2.0 / std::numbers::pi) * nodes.length_m[i] * sd[here];
    if (!nodes.follows_last[i]) continue;
    const double scale = std::sqrt(straight[here] * straight[before]);
    if (scale > 0.0) turn_ += std::acos(std::clamp(covariance(here, before) / scale, -1.0, 1.0));
  }
  offset_sd_ = spread_from_nodes(Layout(most_likely().correction), nodes, sd);
}

double EdgeBelief::band_score(double probability) const {
  const auto misses_at = [&](double q) {
    return 2.0 * (1.0 - normal_probability(q)) +
           2.0 * turn_ / (2.0 * std::numbers::pi) * std::exp(-0.5 * q * q);
  };
  const auto misses = [&](double q) {
    double sum = 0.0;
    for (const auto& [z, weight] : kNormalNodes)
      sum += weight * misses_at(q * std::exp(noise_log_sd_ * z));
    return sum;
  };
  double below = 0.0, above = 40.0;
  for (double middle = 20.0; below < middle && middle < above;
       middle = below + 0.5 * (above - below)) {
    (misses(middle) > 1.0 - probability ? below : above) = middle;
  }
  return kRecalibration * above;
}

}  // namespace palpation
