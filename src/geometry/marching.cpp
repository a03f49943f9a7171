#include "geometry/marching.h"

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "geometry/zeroed_array.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// Of a distance: shorter ways than this do not start a correction.
constexpr double kNews = 1e-9;
/// Of the front's distance when it has reached all targets' faces: how much farther it goes for
/// ways that come from behind.
constexpr double kSettle = 1.02;

/// From the place of the plane that is from_a and from_b away from the ends of an edge, on its
/// other side, to a place on this side, if that line crosses the edge; else infinite. Nothing is
/// worked out that cannot be less than a distance that is known.
template <typename Shape>
double straight_across(const Shape& shape, double from_a, double from_b, double known) {
  const double x =
      ((from_a - from_b) * (from_a + from_b) + shape.length * shape.length) * shape.half_inverse;
  const double depth_squared = from_a * from_a - x * x;
  if (!(depth_squared >= 0.0)) return kInfinite;  // not both are known, or no such place
  const double aside = shape.apex_x - x;
  if (aside * aside + shape.apex_y * shape.apex_y + depth_squared >= known * known)
    return kInfinite;
  const double depth = std::sqrt(depth_squared), rise = shape.apex_y + depth;
  const double crossing = x * shape.apex_y + depth * shape.apex_x;  // times the rise
  return crossing >= 0.0 && crossing <= shape.length * rise ? std::sqrt(aside * aside + rise * rise)
                                                            : kInfinite;
}

}  // namespace

/// The light of one source.
class Front {
 public:
  explicit Front(const Marching& marching)
      : marching_(marching),
        surface_(marching.surface_),
        triangles_(surface_.mesh().triangles),
        known_(static_cast<std::size_t>(surface_.vertex_count())) {}

  void start(const SurfacePoint& source) {
    const Vec3 here = surface_.position(source);
    start_face(source.face, here);
    for (int corner = 0; corner < 3; ++corner) {
      if (source.barycentric[corner] != 0.0) continue;
      // On the edge across from this corner.
      const int across = surface_.neighbour(source.face, (corner + 1) % 3);
      if (across >= 0) start_face(across, here);
    }
    for (int corner = 0; corner < 3; ++corner) {
      if (source.barycentric[corner] == 1.0) reach(triangles_(source.face, corner), 0.0);
    }
  }

  double distance(int vertex) const {
    const Known& known = known_[vertex];
    return known.is_reached ? known.distance : kInfinite;
  }

  /// Until all of these vertices are settled.
  void march(std::vector<int> awaited) {
    double last = kInfinite;
    while (!queue_.empty()) {
      const auto [key, vertex] = queue_.top();
      queue_.pop();
      if (key > last) return;
      if (key > distance(vertex)) continue;
      known_[vertex].is_settled = true;
      spread_from(vertex);
      if (last < kInfinite) continue;
      while (!awaited.empty() && known_[awaited.back()].is_settled) awaited.pop_back();
      if (awaited.empty()) last = kSettle * key;
    }
  }

  /// To a place in a face whose corners are reached, by the same rule.
  double distance_to(const SurfacePoint& target) const {
    const Vec3 here = surface_.position(target);
    const Eigen::Vector3i corners = surface_.triangle(target.face);
    double least = kInfinite;
    for (int i = 0; i < 3; ++i)
      least = std::min(least, distance(corners[i]) + (here - surface_.vertex(corners[i])).norm());
    for (int i = 0; i < 3; ++i) {
      if (target.barycentric[(i + 2) % 3] == 0.0) continue;  // on this edge
      Marching::Shape shape = marching_.shapes_[3 * target.face + i];
      shape.apex_x = target.barycentric[(i + 1) % 3] * shape.length +
                     target.barycentric[(i + 2) % 3] * shape.apex_x;
      shape.apex_y *= target.barycentric[(i + 2) % 3];
      least = std::min(least, straight_across(shape, distance(corners[i]),
                                              distance(corners[(i + 1) % 3]), least));
    }
    return least;
  }

 private:
  struct Known {
    bool is_reached, is_settled;
    double distance;
  };

  void start_face(int face, const Vec3& here) {
    for (const int vertex : triangles_.row(face))
      reach(vertex, (surface_.vertex(vertex) - here).norm());
  }

  void reach(int vertex, double distance) {
    Known& known = known_[vertex];
    if (known.is_reached && distance >= known.distance * (1.0 - kNews)) return;
    known.is_reached = true;
    known.distance = distance;
    queue_.push({distance, vertex});
  }

  /// In every face around a settled vertex to each of the others along the edge, or between the
  /// settled one and the third.
  void spread_from(int a) {
    const double from_a = distance(a);
    for (int i = marching_.first_[a]; i < marching_.first_[static_cast<std::size_t>(a) + 1]; ++i) {
      const int leaving = marching_.leaving_[i], face = leaving / 3, corner = leaving % 3;
      const int arriving = 3 * face + (corner + 2) % 3;
      const int b = triangles_(face, (corner + 1) % 3), c = triangles_(face, (corner + 2) % 3);
      const Marching::Shape &to_b = marching_.shapes_[leaving],
                            &from_c = marching_.shapes_[arriving];
      reach(b, from_a + to_b.length);
      reach(c, from_a + from_c.length);
      reach(c, straight_across(to_b, from_a, distance(b), distance(c)));
      reach(b, straight_across(from_c, distance(c), from_a, distance(b)));
    }
  }

  using Event = std::pair<double, int>;
  const Marching& marching_;
  const Surface& surface_;
  const Triangles& triangles_;
  ZeroedArray<Known> known_;
  std::priority_queue<Event, std::vector<Event>, std::greater<>> queue_;
};

Marching::Marching(const Surface& surface)
    : surface_(surface),
      shapes_(3 * static_cast<std::size_t>(surface.face_count())),
      first_(static_cast<std::size_t>(surface.vertex_count()) + 1, 0),
      leaving_(shapes_.size()) {
  const Points& vertices = surface.mesh().vertices;
  const Triangles& triangles = surface.mesh().triangles;
  for_ranges(surface.face_count(), 4096, [&](int first, int last) {
    for (int half_edge = 3 * first; half_edge < 3 * last; ++half_edge) {
      const int face = half_edge / 3, corner = half_edge % 3;
      const Vec3 a = vertices.row(triangles(face, corner));
      const Vec3 along = vertices.row(triangles(face, (corner + 1) % 3)).transpose() - a,
                 up = vertices.row(triangles(face, (corner + 2) % 3)).transpose() - a;
      const double length = along.norm();
      shapes_[half_edge] = {length, along.dot(up) / length, along.cross(up).norm() / length,
                            0.5 / length};
    }
  });
  for (const int vertex : triangles.reshaped<Eigen::RowMajor>())
    ++first_[static_cast<std::size_t>(vertex) + 1];
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (int half_edge = 0; half_edge < 3 * surface.face_count(); ++half_edge) {
    leaving_[next[triangles(half_edge / 3, half_edge % 3)]++] = half_edge;
  }
}

std::vector<double> Marching::distances(const SurfacePoint& source,
                                        std::span<const SurfacePoint> targets) const {
  Front front(*this);
  front.start(source);
  std::vector<int> awaited;
  for (const SurfacePoint& target : targets) {
    for (const int vertex : surface_.triangle(target.face)) awaited.push_back(vertex);
  }
  front.march(std::move(awaited));
  const Vec3 here = surface_.position(source);
  std::vector<double> distances;
  for (const SurfacePoint& target : targets)
    distances.push_back(target.face == source.face ? (surface_.position(target) - here).norm()
                                                   : front.distance_to(target));
  return distances;
}

}  // namespace palpation
