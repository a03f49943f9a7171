#include "geometry/unfolding.h"

#include <algorithm>

#include "geometry/windows.h"

namespace palpation {
namespace {

/// Follows the light back from where it fell to its source.
class Trace {
 public:
  Trace(const Surface& surface, const Windows& windows) : surface_(surface), windows_(windows) {}

  std::vector<Piece> to(const SurfacePoint& target) {
    const Reached& end = windows_.target();
    if (end.window >= 0) {
      back_through(end.window, target.barycentric);
    } else {
      back_to_origin(end.face, target.barycentric, end.origin);
    }
    std::reverse(pieces_.begin(), pieces_.end());
    return pieces_;
  }

 private:
  void add(int face, const Vec3& from, const Vec3& to) {
    if (from != to) pieces_.push_back({face, from, to});
  }

  int corner_of(int face, int vertex) const {
    const Eigen::Vector3i corners = surface_.triangle(face);
    return corners[0] == vertex ? 0 : corners[1] == vertex ? 1 : corners[2] == vertex ? 2 : -1;
  }

  /// The source's weights in a face that contains it.
  Vec3 weights_in(int face, const SurfacePoint& source) const {
    if (face == source.face) return source.barycentric;
    Vec3 weights = Vec3::Zero();
    for (int corner = 0; corner < 3; ++corner) {
      const int there = corner_of(face, surface_.triangle(source.face)[corner]);
      if (there >= 0) weights[there] = source.barycentric[corner];
    }
    return weights;
  }

  /// From a place in a face to the origin, which is a place of the same face, and on from there.
  void back_to_origin(int face, const Vec3& weights, int origin) {
    if (origin < 0) {
      add(face, weights_in(face, windows_.source(-1 - origin)), weights);
      return;
    }
    Vec3 corner = Vec3::Zero();
    corner[corner_of(face, origin)] = 1.0;
    add(face, corner, weights);
    const Reached& reached = windows_.vertex(origin);
    if (reached.window >= 0) {
      const int half_edge = windows_.window(reached.window).half_edge;
      Vec3 apex = Vec3::Zero();
      apex[(half_edge % 3 + 2) % 3] = 1.0;
      back_through(reached.window, apex);
    } else if (reached.distance > 0.0) {
      Vec3 there = Vec3::Zero();
      there[corner_of(reached.face, origin)] = 1.0;
      back_to_origin(reached.face, there, reached.origin);
    }
  }

  /// From a place in the face that a window opens into.
  void back_through(int number, Vec3 weights) {
    while (true) {
      const Window& window = windows_.window(number);
      const int face = window.half_edge / 3, corner = window.half_edge % 3;
      const EdgeFrame frame = windows_.frames().frame(window.half_edge);
      const Vec2 place = windows_.frames().in_frame(window.half_edge, frame, weights);
      const double rise = place.y() - window.image.y();
      double along = place.x();
      if (rise > 0.0)
        along = window.image.x() - window.image.y() / rise * (place.x() - window.image.x());
      along = std::clamp(along, window.from, window.to);
      const double share = along / frame.length;
      const int parent = windows_.parent_at(number, along);
      Vec3 entry = Vec3::Zero();
      entry[corner] = 1.0 - share;
      entry[(corner + 1) % 3] = share;
      add(face, entry, weights);
      const int across = windows_.frames().opposite(window.half_edge);
      weights = Vec3::Zero();
      weights[across % 3] = share;
      weights[(across % 3 + 1) % 3] = 1.0 - share;
      if (parent < 0) {
        back_to_origin(across / 3, weights, window.origin);
        return;
      }
      number = parent;
    }
  }

  const Surface& surface_;
  const Windows& windows_;
  std::vector<Piece> pieces_;  // from the end to the start
};

}  // namespace

Field unfolded_distances(const Surface& surface, std::span<const SurfacePoint> sources,
                         const UnfoldingLimits& limits) {
  Windows windows(surface, sources, limits.radius_m, /*keeps_paths=*/false);
  windows.spread();
  Field distances =
      Field::Constant(surface.vertex_count(), std::numeric_limits<double>::infinity());
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    const Reached& reached = windows.vertex(vertex);
    if (reached.is_known && reached.distance <= limits.radius_m)
      distances[vertex] = reached.distance;
  }
  return distances;
}

std::vector<double> unfolded_distances_of(const Surface& surface, const SurfacePoint& source,
                                          std::span<const int> vertices, double radius_m) {
  Windows windows(surface, std::span(&source, 1), radius_m, /*keeps_paths=*/false);
  windows.spread();
  std::vector<double> distances;
  for (const int vertex : vertices) {
    const Reached& reached = windows.vertex(vertex);
    distances.push_back(reached.is_known && reached.distance <= radius_m
                            ? reached.distance
                            : std::numeric_limits<double>::infinity());
  }
  return distances;
}

std::optional<ShortestPath> unfolded_path(const Surface& surface, const SurfacePoint& from,
                                          const SurfacePoint& to, double at_most_m) {
  Windows windows(surface, std::span(&from, 1), std::numeric_limits<double>::infinity(),
                  /*keeps_paths=*/true);
  windows.aim_at(to, at_most_m);
  windows.spread();
  if (!windows.target().is_known) return std::nullopt;
  return ShortestPath{windows.target().distance, Trace(surface, windows).to(to)};
}

}  // namespace palpation
