#include "certainty/edge_belief_fit.h"

#include <algorithm>
#include <cmath>

namespace palpation {

double EdgeBelief::Fit::shift_m() const {
  return std::log(fraction / (1.0 - fraction)) / std::exp(edge.profile[2]);
}

Eigen::MatrixXd EdgeBelief::Fit::profile_covariance() const {
  const Eigen::MatrixXd variance = prior.variance.asDiagonal();
  const ProfileSlopes shared = edge.by_profile * variance;
  return variance - shared.transpose() * edge.covariance.solve(shared);
}

EdgeProfile EdgeBelief::Fit::edge_profile() const {
  Eigen::VectorXd of_level = Eigen::VectorXd::Zero(edge.profile.size());
  of_level.head<2>() << 1.0 - fraction, fraction;
  const double variance = of_level.dot(profile_covariance() * of_level);
  const double low = edge.profile[0], high = edge.profile[1];
  return {.low = low,
          .high = high,
          .slope_per_m = std::exp(edge.profile[2]),
          .shift_m = shift_m(),
          .level = {low + fraction * (high - low), std::sqrt(std::max(variance, 0.0))}};
}

Eigen::MatrixXd EdgeBelief::Fit::readings_with_depths(std::span<const SurfacePoint> points) const {
  Eigen::MatrixXd shared = edge.by_depth.asDiagonal() * correction.covariance(data.places, points);
  // depth = distance + correction - logit(fraction) / slope, whose derivative by log slope is the
  // shift.
  shared.colwise() += edge.by_profile.col(2) * (prior.variance[2] * shift_m());
  return shared;
}

Eigen::MatrixXd EdgeBelief::Fit::depth_covariance(std::span<const SurfacePoint> points) const {
  if (points.empty()) return {};
  Eigen::MatrixXd shared = readings_with_depths(points);
  edge.covariance.matrixL().solveInPlace(shared);
  Eigen::MatrixXd covariance = correction.covariance(points, points);
  covariance.array() += shift_m() * shift_m() * prior.variance[2];
  covariance.noalias() -= shared.transpose() * shared;
  return covariance;
}

Field EdgeBelief::Fit::depth_at_vertices() const {
  const Surface& surface = correction.surface();
  Field at_vertices = distance_m.array() - shift_m();
  std::vector<SurfacePoint> near;
  std::vector<int> vertices;
  for (int vertex = 0; vertex < distance_m.size(); ++vertex) {
    if (std::abs(distance_m[vertex]) > kReach * correction.kernel().signal_sd) continue;
    vertices.push_back(vertex);
    near.push_back(surface.at_vertex(vertex));
  }
  // Corrections alone move it: the shift is that of the most probable slope already.
  const Eigen::VectorXd moved =
      correction.covariance(near, data.places) * edge.by_depth.cwiseProduct(edge.pull);
  for (std::size_t i = 0; i < vertices.size(); ++i) at_vertices[vertices[i]] += moved[i];
  return at_vertices;
}

}  // namespace palpation
