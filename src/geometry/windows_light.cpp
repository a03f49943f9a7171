// Where light comes from: sources, and the vertices that it bends at.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/windows.h"

namespace palpation {
namespace {

/// Weights below this are rounding: the place is on the edge, or at the corner.
constexpr double kOnEdge = 1e-12;
/// Radians: a vertex with less surplus than this is flat.
constexpr double kFlat = 1e-10;

}  // namespace

/// A shortest path only bends at vertices with more than a full angle around, or more than half of
/// one at a border.
bool Windows::light_bends_at(int vertex) const {
  frames_.fan_around(vertex, fan_);
  return fan_.angle() > (fan_.closes ? 2.0 : 1.0) * std::numbers::pi + kFlat;
}

void Windows::light_face_from(int number, int face, const Vec3& barycentric) {
  const Vec3 here = frames_.place({face, barycentric});
  for (int corner = 0; corner < 3; ++corner) reach_straight(face, corner, 0.0, -1 - number, here);
  if (target_ && face == target_->face())
    target_->reach((target_->place() - here).norm(), -1, -1 - number, face);
  for (int corner = 0; corner < 3; ++corner) {
    if (barycentric[(corner + 2) % 3] == 0.0) continue;  // on this edge itself
    const int across = frames_.opposite(3 * face + corner);
    if (across < 0) continue;
    const EdgeFrame inner = frames_.frame(3 * face + corner);
    const Vec2 place_here = frames_.in_frame(3 * face + corner, inner, barycentric);
    const Vec2 image(inner.length - place_here.x(), -place_here.y());
    add({across, -1, -1 - number, 0.0, inner.length, image, 0.0});
  }
}

void Windows::light_from(int number) {
  SurfacePoint& source = sources_[number];
  Vec3& weights = source.barycentric;
  weights = (weights.array() < kOnEdge).select(0.0, weights);
  weights /= weights.sum();
  for (int corner = 0; corner < 3; ++corner) {
    if (weights[(corner + 1) % 3] != 0.0 || weights[(corner + 2) % 3] != 0.0) continue;
    const int vertex = frames_.corner(source.face, corner);
    reached_[vertex] = {true, 0.0, -1, -1 - number, source.face, 0.0};
    see_target_from(vertex, 0.0);
    bend_at(vertex);
    return;
  }
  light_face_from(number, source.face, weights);
  for (int corner = 0; corner < 3; ++corner) {
    if (weights[(corner + 2) % 3] != 0.0) continue;
    const int across = frames_.opposite(3 * source.face + corner);
    if (across < 0) return;
    Vec3 there = Vec3::Zero();
    there[across % 3] = weights[(corner + 1) % 3];
    there[(across % 3 + 1) % 3] = weights[corner];
    light_face_from(number, across / 3, there);
    return;
  }
}

/// Light from a vertex into one of its faces, between two angles of the fan.
void Windows::light_blade(const Blade& blade, int vertex, double distance, double first,
                          double last) {
  if (first > blade.start + blade.angle || last < blade.start) return;
  const int facing = 3 * blade.face + (blade.corner + 1) % 3;
  const int across = frames_.opposite(facing);
  if (across < 0) return;
  const EdgeFrame inner = frames_.frame(facing);
  const auto hit = [&](double angle) {
    const Vec2 edge = -inner.apex.normalized();
    const Vec2 ray(std::cos(angle) * edge.x() - std::sin(angle) * edge.y(),
                   std::sin(angle) * edge.x() + std::cos(angle) * edge.y());
    return ray.y() < 0.0
               ? std::clamp(inner.apex.x() - inner.apex.y() / ray.y() * ray.x(), 0.0, inner.length)
               : 0.0;
  };
  const double from = first > blade.start ? hit(first - blade.start) : 0.0;
  const double to = last < blade.start + blade.angle ? hit(last - blade.start) : inner.length;
  if (to - from <= kNarrowWindow * inner.length) return;
  add({across, -1, vertex, inner.length - to, inner.length - from,
       Vec2(inner.length - inner.apex.x(), -inner.apex.y()), distance});
}

/// Light that comes to a vertex goes on where no shorter way leads past it: at least half a turn
/// from where it came on either side. From a source it goes everywhere.
void Windows::bend_at(int vertex) {
  const Reached reached = reached_[vertex];
  frames_.fan_around(vertex, fan_);
  const double whole = fan_.angle(), half = std::numbers::pi - kFlat;
  double arrival = 0.0;
  for (const Blade& blade : fan_.blades) {
    if (blade.face == reached.face) arrival = blade.start + reached.arrival;
  }
  const Fan fan = fan_;  // reach() looks at other fans
  for (const Blade& blade : fan.blades) {
    for (const int corner : {(blade.corner + 1) % 3, (blade.corner + 2) % 3})
      reach_straight(blade.face, corner, reached.distance, vertex, frames_.place(vertex));
    if (reached.distance == 0.0) {
      light_blade(blade, vertex, 0.0, 0.0, whole);
    } else if (fan.closes) {
      light_blade(blade, vertex, reached.distance, arrival + half, arrival + whole - half);
      light_blade(blade, vertex, reached.distance, arrival + half - whole, arrival - half);
    } else {
      light_blade(blade, vertex, reached.distance, arrival + half, whole);
      light_blade(blade, vertex, reached.distance, 0.0, arrival - half);
    }
  }
}

}  // namespace palpation
