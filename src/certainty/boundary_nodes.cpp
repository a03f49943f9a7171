#include "certainty/boundary_nodes.h"

#include <cmath>

#include "palpation/boundary/level_set.h"

namespace palpation {
namespace {

constexpr double kSpacing_m = 0.0008;
constexpr double kFarOff = 20.0;  // squared, in spacings: a weight of e^-10

}  // namespace

BoundaryNodes boundary_nodes(const Surface& surface, const Field& depth) {
  BoundaryNodes nodes;
  for (const LevelLoop& loop : level_loops(surface, depth, 0.0)) {
    double run = 0.0;
    bool follows = false;
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      if (loop.on_border[i]) {
        follows = false;
        continue;
      }
      const SurfacePoint& next = loop.points[(i + 1) % loop.points.size()];
      run += (surface.position(next) - surface.position(loop.points[i])).norm();
      if (run < kSpacing_m && i + 1 < loop.points.size()) continue;
      nodes.points.push_back(next);
      nodes.length_m.push_back(run);
      nodes.follows_last.push_back(follows);
      follows = true;
      run = 0.0;
    }
  }
  return nodes;
}

Field spread_from_nodes(const Layout& layout, const BoundaryNodes& nodes,
                        const Eigen::VectorXd& values) {
  const Surface& surface = layout.surface();
  const auto count = static_cast<Eigen::Index>(nodes.points.size());
  if (count == 0) return Field::Zero(surface.vertex_count());
  Eigen::Matrix3Xd places(3, count);
  for (Eigen::Index node = 0; node < count; ++node)
    places.col(node) = layout.at(nodes.points[node]);
  Field spread(surface.vertex_count());
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    const Eigen::ArrayXd squared =
        (places.colwise() - layout.at(vertex)).colwise().squaredNorm().transpose();
    const double nearest = squared.minCoeff();
    double weights = 0.0, sum = 0.0;
    for (Eigen::Index node = 0; node < count; ++node) {
      if (squared[node] - nearest > kFarOff * kSpacing_m * kSpacing_m) continue;
      const double weight = std::exp(-0.5 * (squared[node] - nearest) / (kSpacing_m * kSpacing_m));
      weights += weight;
      sum += weight * values[node];
    }
    spread[vertex] = sum / weights;
  }
  return spread;
}

}  // namespace palpation
