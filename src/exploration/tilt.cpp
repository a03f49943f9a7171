#include "exploration/tilt.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/sigmoid.h"
#include "readings/readings.h"
#include "readings/robust.h"

namespace palpation {
namespace {

/// Of how the readings differ.
constexpr double kLeastPlane = 0.15;
constexpr Eigen::Index kFewestOnPlane = 15;
/// Of weighing: no fit changes by a hundredth after.
constexpr int kWeighings = 5;

struct Plane {
  Vec3 slope_per_m = Vec3::Zero();
  double gain = 0.0;  ///< nats: of the values as normal ones, over a constant
};

/// Along which places, rows, spread the most: a ridge rises with the height of curved tissue, and
/// that is no tilt.
Eigen::Matrix<double, 3, 2> main_axes(const Eigen::MatrixXd& places) {
  const Eigen::MatrixXd off_middle = places.rowwise() - places.colwise().mean();
  const Eigen::Matrix3d spread = off_middle.transpose() * off_middle;
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().rightCols<2>();
}

/// Through values at places, which are its rows. What stands out by itself tilts nothing: weights
/// are Cauchy's.
Plane plane_through(const Eigen::MatrixXd& places, const Eigen::VectorXd& values) {
  Plane plane;
  const Eigen::Matrix<double, 3, 2> axes = main_axes(places);
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(values.size());
  for (int round = 0; round < kWeighings; ++round) {
    const Eigen::RowVector3d middle = (weight.transpose() * places) / weight.sum();
    const double mean = weight.dot(values) / weight.sum();
    const Eigen::MatrixXd off_middle = (places.rowwise() - middle) * axes;
    const Eigen::VectorXd root = weight.cwiseSqrt(), off_mean = values.array() - mean;
    const Eigen::Vector2d slope = (root.asDiagonal() * off_middle)
                                      .completeOrthogonalDecomposition()
                                      .solve(root.cwiseProduct(off_mean));
    plane.slope_per_m = axes * slope;
    const Eigen::VectorXd left = off_mean - off_middle * slope;
    const double before = weight.dot(off_mean.cwiseAbs2()), after = weight.dot(left.cwiseAbs2());
    if (!(after > 0.0)) return plane;
    plane.gain = 0.5 * static_cast<double>(values.size()) * std::log(before / after);
    const double scale = robust_sd({left.begin(), left.end()});
    if (!(scale > 0.0)) return plane;
    weight = (1.0 + (left / scale).array().square()).inverse();
  }
  return plane;
}

Eigen::MatrixXd places_of(const Surface& surface, std::span<const Palpation> palpations) {
  Eigen::MatrixXd places(static_cast<Eigen::Index>(palpations.size()), 3);
  for (Eigen::Index row = 0; row < places.rows(); ++row)
    places.row(row) = surface.position(palpations[static_cast<std::size_t>(row)].where).transpose();
  return places;
}

Misfit as_change(const Surface& surface, const Vec3& slope_per_m) {
  return {.kind = MisfitKind::Tilted,
          .slope_per_m = slope_per_m,
          .middle = surface.mesh().vertices.colwise().mean().transpose()};
}

}  // namespace

bool may_be_tilted(const Surface& surface, std::span<const Palpation> palpations) {
  return explained_by_plane(surface, palpations) > kLeastPlane;
}

/// Coordinates of the metric need not be those of space: what the slope adds at the readings'
/// places is a plane in space, or nearly one.
Misfit tilt_of(const Belief& sloped) {
  const std::vector<Palpation> palpations = sloped.palpations(),
                               without = sloped.detrended_palpations();
  Eigen::VectorXd added(static_cast<Eigen::Index>(palpations.size()));
  for (Eigen::Index row = 0; row < added.size(); ++row) {
    const auto i = static_cast<std::size_t>(row);
    added[row] = palpations[i].reading - without[i].reading;
  }
  const Surface& surface = sloped.prior().surface();
  return as_change(surface, plane_through(places_of(surface, palpations), added).slope_per_m);
}

std::optional<Misfit> tilt_left(const Surface& surface, const EdgeBelief& edge,
                                std::span<const Palpation> palpations) {
  const EdgeProfile& profile = edge.profile();
  std::vector<Palpation> used;
  std::ranges::copy_if(palpations, std::back_inserter(used), counts);
  Eigen::VectorXd left(static_cast<Eigen::Index>(used.size()));
  if (left.size() < kFewestOnPlane) return std::nullopt;
  for (Eigen::Index row = 0; row < left.size(); ++row) {
    const Palpation& one = used[static_cast<std::size_t>(row)];
    const double depth_m = surface.interpolate(edge.depth(), one.where) + profile.shift_m;
    left[row] = one.reading - profile.low -
                (profile.high - profile.low) * sigmoid(profile.slope_per_m * depth_m);
  }
  const Plane plane = plane_through(places_of(surface, used), left);
  const double chance = surprising() + std::log(static_cast<double>(used.size()));
  if (!(plane.gain > chance)) return std::nullopt;
  return as_change(surface, plane.slope_per_m);
}

Misfit tilt_together(Misfit one, const Misfit& other) {
  one.slope_per_m += other.slope_per_m;
  return one;
}

double log_evidence_of_plane(const Belief& sloped) {
  const std::vector<double> flat = used_readings(sloped.detrended_palpations());
  const auto count = static_cast<double>(flat.size());
  const double variance = std::max(std::pow(spread_of(flat).sd, 2), sloped.noise_variance());
  return -0.5 * count * (1.0 + std::log(variance)) - 0.5 * std::log(count);
}

}  // namespace palpation
