#include "exploration/tilt.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

#include "exploration/parallel_planes.h"
#include "readings/readings.h"
#include "readings/robust.h"

namespace palpation {
namespace {

constexpr Eigen::Index kFewestOnPlane = 15;
/// Of weighing: no fit changes by a hundredth after.
constexpr int kWeighings = 5;
/// Of parallel planes: each costs a conclusion.
constexpr int kPairs = 2;

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

Misfit as_change(const Surface& surface, const Vec3& slope_per_m) {
  return {.kind = MisfitKind::Tilted,
          .background = {.slope_per_m = slope_per_m,
                         .middle = surface.mesh().vertices.colwise().mean().transpose()}};
}

}  // namespace

double tilt_price(Eigen::Index readings) {
  return surprising() + std::log(static_cast<double>(readings));
}

std::vector<Misfit> tilts_of_planes(const Surface& surface, std::span<const Palpation> palpations) {
  const auto [places, values] = placed_readings(surface, palpations);
  if (values.size() < kFewestOnPlane) return {};
  const Eigen::Matrix<double, 3, 2> axes = main_axes(places);
  const std::vector<Eigen::Vector2d> slopes =
      slopes_of_parallel_planes(places * axes, values, tilt_price(values.size()), kPairs);
  if (slopes.empty()) return {};
  std::vector<Misfit> tilts = {as_change(surface, plane_through(places, values).slope_per_m)};
  for (const Eigen::Vector2d& slope : slopes) tilts.push_back(as_change(surface, axes * slope));
  return tilts;
}

std::optional<Misfit> tilt_left(const Surface& surface, const EdgeBelief& edge,
                                std::span<const Palpation> palpations) {
  const EdgeProfile& profile = edge.profile();
  auto [places, left] = placed_readings(surface, palpations);
  if (left.size() < kFewestOnPlane) return std::nullopt;
  Eigen::Index row = 0;
  for (const Palpation& one : palpations) {
    if (!counts(one)) continue;
    const double share = share_at_depth(profile, surface.interpolate(edge.depth(), one.where));
    left[row++] -= profile.low + share * (profile.high - profile.low);
  }
  const Plane plane = plane_through(places, left);
  if (!(plane.gain > tilt_price(left.size()))) return std::nullopt;
  return as_change(surface, plane.slope_per_m);
}

Misfit tilt_together(Misfit one, const Misfit& other) {
  one.background.slope_per_m += other.background.slope_per_m;
  return one;
}

}  // namespace palpation
