#include "geometry/marching.h"

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "geometry/zeroed_array.h"

namespace palpation {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// Of a distance: shorter ways than this do not start a correction.
constexpr double kNews = 1e-9;
/// Of the front's distance when it has reached all targets' faces: how much farther it goes for ways that come from behind.
constexpr double kSettle = 1.02;

/// From the place of the plane that is from_a and from_b away from the ends of an edge, on its other side, to a place on this side, if that
/// line crosses the edge; else infinite.
double straight_across(const Vec3& a, const Vec3& b, double from_a, double from_b, const Vec3& place) {
  const Vec3 along = b - a, up = place - a;
  const double length = along.norm();
  const double x = (from_a * from_a - from_b * from_b + length * length) / (2.0 * length);
  const double depth_squared = from_a * from_a - x * x;
  if (!(depth_squared >= 0.0)) return kInfinite;  // not both are known, or no such place
  const Vec2 source(x, -std::sqrt(depth_squared)), apex(along.dot(up) / length, along.cross(up).norm() / length);
  const double crossing = source.x() - source.y() / (apex.y() - source.y()) * (apex.x() - source.x());
  return crossing >= 0.0 && crossing <= length ? (apex - source).norm() : kInfinite;
}

class Front {
 public:
  Front(const Surface& surface)
      : surface_(surface), vertices_(surface.mesh().vertices), triangles_(surface.mesh().triangles), known_(surface.vertex_count()) {}

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
    return known_[static_cast<std::size_t>(vertex)].is_reached ? known_[static_cast<std::size_t>(vertex)].distance : kInfinite;
  }

  /// Until all of these vertices are settled.
  void march(std::vector<int> awaited) {
    double last = kInfinite;
    while (!queue_.empty()) {
      const auto [key, vertex] = queue_.top();
      queue_.pop();
      if (key > last) return;
      if (key > distance(vertex)) continue;
      known_[static_cast<std::size_t>(vertex)].is_settled = true;
      spread_from(vertex);
      if (last < kInfinite) continue;
      while (!awaited.empty() && known_[static_cast<std::size_t>(awaited.back())].is_settled) awaited.pop_back();
      if (awaited.empty()) last = kSettle * key;
    }
  }

 private:
  struct Known {
    bool is_reached, is_settled;
    double distance;
  };

  Vec3 place(int vertex) const { return vertices_.row(vertex); }

  void start_face(int face, const Vec3& here) {
    for (const int vertex : triangles_.row(face)) reach(vertex, (place(vertex) - here).norm());
  }

  void reach(int vertex, double distance) {
    Known& known = known_[static_cast<std::size_t>(vertex)];
    if (known.is_reached && distance >= known.distance * (1.0 - kNews)) return;
    known.is_reached = true;
    known.distance = distance;
    queue_.push({distance, vertex});
  }

  void spread_from(int vertex) {
    const int first = surface_.face_of_vertex(vertex);
    int face = first;
    for (const bool forward : {true, false}) {
      while (face >= 0) {
        const int corner = triangles_(face, 0) == vertex ? 0 : triangles_(face, 1) == vertex ? 1 : 2;
        if (forward || face != first) spread_in(face, corner);
        face = surface_.neighbour(face, forward ? (corner + 2) % 3 : corner);
        if (face == first) return;
      }
      face = first;
    }
  }

  /// A face with a settled corner: to each of the others along the edge, or between the settled one and the third.
  void spread_in(int face, int corner) {
    const int a = triangles_(face, corner), b = triangles_(face, (corner + 1) % 3), c = triangles_(face, (corner + 2) % 3);
    const double from_a = distance(a);
    reach(b, from_a + (place(b) - place(a)).norm());
    reach(c, from_a + (place(c) - place(a)).norm());
    reach_across(a, b, c);
    reach_across(a, c, b);
  }

  void reach_across(int a, int b, int c) {
    const double across = straight_across(place(a), place(b), distance(a), distance(b), place(c));
    if (across < kInfinite) reach(c, across);
  }

  using Event = std::pair<double, int>;
  const Surface& surface_;
  const Points& vertices_;
  const Triangles& triangles_;
  ZeroedArray<Known> known_;
  std::priority_queue<Event, std::vector<Event>, std::greater<>> queue_;
};

/// To a place in a face whose corners are reached, by the same rule.
double distance_in(const Surface& surface, const Front& front, const SurfacePoint& target) {
  const Vec3 here = surface.position(target);
  const Eigen::Vector3i corners = surface.triangle(target.face);
  double least = kInfinite;
  for (int i = 0; i < 3; ++i) least = std::min(least, front.distance(corners[i]) + (here - surface.vertex(corners[i])).norm());
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (target.barycentric[(i + 2) % 3] == 0.0) continue;  // on this edge
    least = std::min(least, straight_across(surface.vertex(corners[i]), surface.vertex(corners[j]), front.distance(corners[i]),
                                            front.distance(corners[j]), here));
  }
  return least;
}

}  // namespace

std::vector<double> marched_distances(const Surface& surface, const SurfacePoint& source, std::span<const SurfacePoint> targets) {
  Front front(surface);
  front.start(source);
  std::vector<int> awaited;
  for (const SurfacePoint& target : targets) {
    for (const int vertex : surface.triangle(target.face)) awaited.push_back(vertex);
  }
  front.march(std::move(awaited));
  const Vec3 here = surface.position(source);
  std::vector<double> distances;
  for (const SurfacePoint& target : targets) {
    distances.push_back(target.face == source.face ? (surface.position(target) - here).norm() : distance_in(surface, front, target));
  }
  return distances;
}

}  // namespace palpation
