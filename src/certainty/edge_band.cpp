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

/// Laplace's approximation takes the profile as straight. Where the boundary may be off by a good
/// part of the edge's width, readings tell less than that: the offset's variance grows by this much
/// for a standard deviation of 1 / slope (found on simulated tumours).
constexpr double kCurved = 3.0;
/// Its tails are heavier than a normal's, and so are the outlines': a missed arm, a corner. The
/// band is this many times as wide as Rice's formula has it (found on the worlds of seeds 0 to 64).
constexpr double kHeavyTail = 1.8;

/// Gauss and Hermite's five nodes for the mean over a standard normal variable.
constexpr std::array<std::pair<double, double>, 5> kNormalNodes = {
    {{-2.856970013872806, 0.011257411327720691},
     {-1.355626179974266, 0.22207592200561266},
     {0.0, 8.0 / 15.0},
     {1.355626179974266, 0.22207592200561266},
     {2.856970013872806, 0.011257411327720691}}};

}  // namespace

/// Offsets at nodes along the boundary: how sure they are, and how they go together. Where the
/// boundary lies, the readings decide between the kinds of outline. How sure that is, they do not:
/// corners are few, and what most of an outline is like says little of the rest, so for that both
/// kinds count alike.
void EdgeBelief::survey_boundary() {
  const BoundaryNodes nodes = boundary_nodes(surface_, depth_);
  const auto count = static_cast<Eigen::Index>(nodes.points.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count, count);
  for (const auto& fit : fits_) {
    Eigen::VectorXd off(count);
    for (Eigen::Index node = 0; node < count; ++node)
      off[node] = surface_.interpolate(fit->depth, nodes.points[node]);
    covariance += fit->depth_covariance(nodes.points) + off * off.transpose();
  }
  covariance /= static_cast<double>(fits_.size());
  const Eigen::VectorXd as_if_straight = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  const Eigen::ArrayXd part_of_edge = as_if_straight.array() * profile_.slope_per_m;
  const Eigen::VectorXd sd =
      as_if_straight.array() * (1.0 + kCurved * part_of_edge.square()).sqrt();
  expected_error_m2_ = turn_ = 0.0;
  for (std::size_t i = 0; i < nodes.points.size(); ++i) {
    const auto here = static_cast<Eigen::Index>(i), before = here - 1;
    expected_error_m2_ += std::sqrt(2.0 / std::numbers::pi) * nodes.length_m[i] * sd[here];
    if (!nodes.follows_last[i]) continue;
    const double scale = as_if_straight[here] * as_if_straight[before];
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
  return kHeavyTail * above;
}

}  // namespace palpation
