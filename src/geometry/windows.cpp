#include "geometry/windows.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpation {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// Weights below this are rounding: the place is on the edge, or at the corner.
constexpr double kOnEdge = 1e-12;
/// Of an edge's length: light this close beside a corner still sees it, and windows this narrow are
/// none.
constexpr double kVisible = 1e-10;
constexpr double kNarrow = 1e-13;
/// Of a distance: images of one source that are nearer are one.
constexpr double kSameImage = 1e-11;
/// Of a distance: ways that differ by less are equally long, and both are kept.
constexpr double kEqual = 1e-12;
/// Light that bends at a vertex need not bend there anew for ways that are shorter by so little.
constexpr double kNews = 1e-9;
/// Radians: a vertex with less surplus than this is flat.
constexpr double kFlat = 1e-10;

/// Where the line from the image to a place above the edge crosses the edge.
double crossing_of(const Vec2& image, const Vec2& place) {
  const double rise = place.y() - image.y();
  return rise > 0.0 ? image.x() - image.y() / rise * (place.x() - image.x()) : place.x();
}

/// From one direction counter-clockwise to another.
double angle_between(const Vec2& a, const Vec2& b) {
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

double to_interval(const Window& window) {
  const double aside =
      std::max({window.from - window.image.x(), window.image.x() - window.to, 0.0});
  return std::hypot(aside, window.image.y());
}

/// Another frame in the same plane: its origin, and the direction of its x axis.
struct Turned {
  Vec2 origin, x;
  Vec2 operator()(const Vec2& p) const {
    const Vec2 arm = p - origin;
    return {x.dot(arm), x.x() * arm.y() - x.y() * arm.x()};
  }
};

}  // namespace

Windows::Windows(const Surface& surface, std::span<const SurfacePoint> sources, double radius_m,
                 bool keeps_paths)
    : surface_(surface),
      vertices_(surface.mesh().vertices),
      triangles_(surface.mesh().triangles),
      sources_(sources.begin(), sources.end()),
      radius_m_(radius_m),
      keeps_paths_(keeps_paths),
      reached_(static_cast<std::size_t>(surface.vertex_count())),
      best_(3 * static_cast<std::size_t>(surface.face_count())),
      waiting_(3 * static_cast<std::size_t>(surface.face_count())) {}

void Windows::aim_at(const SurfacePoint& target, double at_most_m) {
  is_aimed_ = true;
  aim_ = target;
  aim_place_ = surface_.position(target);
  at_most_m_ = at_most_m;
}

EdgeFrame Windows::frame(int half_edge) const {
  const Vec3 a = place(start(half_edge));
  const Vec3 along = place(end(half_edge)) - a, up = place(apex(half_edge)) - a;
  const double length = along.norm();
  return {length, Vec2(along.dot(up) / length, along.cross(up).norm() / length)};
}

Vec2 Windows::in_frame(int half_edge, const EdgeFrame& frame, const Vec3& barycentric) const {
  const int corner = half_edge % 3;
  return barycentric[(corner + 1) % 3] * Vec2(frame.length, 0.0) +
         barycentric[(corner + 2) % 3] * frame.apex;
}

int Windows::opposite(int half_edge) const {
  const int face = surface_.neighbour(half_edge / 3, half_edge % 3);
  if (face < 0) return -1;
  const int first = end(half_edge);
  for (int corner = 0; corner < 3; ++corner) {
    if (triangles_(face, corner) == first) return 3 * face + corner;
  }
  return -1;
}

double Windows::known_distance(int vertex) const {
  const Reached& reached = reached_[vertex];
  return reached.is_known ? reached.distance : kInfinite;
}

bool Windows::fan_around(int vertex) const {
  const auto corner_of = [&](int face) {
    return triangles_(face, 0) == vertex ? 0 : triangles_(face, 1) == vertex ? 1 : 2;
  };
  const int any = surface_.face_of_vertex(vertex);
  int first = any;
  for (int before = surface_.neighbour(first, corner_of(first)); before >= 0 && before != any;) {
    first = before;
    before = surface_.neighbour(first, corner_of(first));
  }
  if (surface_.neighbour(first, corner_of(first)) == any) first = any;
  fan_.clear();
  double start = 0.0;
  int face = first;
  do {
    const int corner = corner_of(face);
    const Vec3 next = place(triangles_(face, (corner + 1) % 3)) - place(vertex),
               last = place(triangles_(face, (corner + 2) % 3)) - place(vertex);
    const double angle = std::atan2(next.cross(last).norm(), next.dot(last));
    fan_.push_back({face, corner, start, angle});
    start += angle;
    face = surface_.neighbour(face, (corner + 2) % 3);
  } while (face >= 0 && face != first);
  return face == first;
}

/// A shortest path only bends at vertices with more than a full angle around, or more than half of
/// one at a border.
bool Windows::light_bends_at(int vertex) const {
  const bool closes = fan_around(vertex);
  const double whole = fan_.back().start + fan_.back().angle;
  return whole > (closes ? 2.0 : 1.0) * std::numbers::pi + kFlat;
}

bool Windows::is_too_far(double distance, int half_edge) const {
  if (distance > radius_m_) return true;
  if (!is_aimed_) return false;
  const double longest =
      std::min(at_most_m_, target_.is_known ? target_.distance : kInfinite) * (1.0 + kEqual);
  if (distance > longest) return true;
  const Vec3 a = place(start(half_edge)), b = place(end(half_edge));
  return distance + (0.5 * (a + b) - aim_place_).norm() - 0.5 * (b - a).norm() > longest;
}

void Windows::reach_target(double distance, int window, int origin, int face) {
  if (distance > at_most_m_ * (1.0 + kEqual) || (target_.is_known && distance >= target_.distance))
    return;
  target_ = {true, distance, window, origin, face, 0.0};
}

void Windows::reach(int vertex, const Reached& now) {
  Reached& reached = reached_[vertex];
  if (reached.is_known && now.distance >= reached.distance) return;
  const bool is_news = !reached.is_known || now.distance < reached.distance * (1.0 - kEqual);
  reached = now;
  if (is_news && now.distance <= radius_m_ && light_bends_at(vertex))
    events_.push({now.distance, -1, vertex});
  if (!is_aimed_) return;
  // The target may be at this vertex, or be seen from it.
  for (const int corner : triangles_.row(aim_.face)) {
    if (corner == vertex)
      reach_target(now.distance + (aim_place_ - place(vertex)).norm(), -1, vertex, aim_.face);
  }
}

/// A corner of a face, straight through that face from a place in it.
void Windows::reach_straight(int face, int corner, double distance, int origin, const Vec3& from) {
  const int vertex = triangles_(face, corner);
  const Vec3 next = place(triangles_(face, (corner + 1) % 3)) - place(vertex),
             back = from - place(vertex);
  reach(vertex, {true, distance + back.norm(), -1, origin, face,
                 std::atan2(next.cross(back).norm(), next.dot(back))});
}

/// Every vertex splits the light that passes it. Where both parts come to one edge again and the
/// first is still waiting, they are made one anew, or there would be a window for every vertex that
/// light has passed (Mitchell, Mount and Papadimitriou 1987 keep windows whole). True if nothing is
/// left to be added.
bool Windows::joins(Window& window, double distance) {
  const int number = waiting_[window.half_edge] - 1;
  if (number < 0) return false;
  Window& other = windows_[number];
  if (other.origin != window.origin || other.sigma != window.sigma) return false;
  const double size = other.image.norm() + std::max(other.to, window.to),
               slack = kVisible * std::max(other.to, window.to);
  if ((other.image - window.image).norm() > kSameImage * size) return false;
  if (std::abs(other.to - window.from) > slack && std::abs(window.to - other.from) > slack)
    return false;
  const double from = std::min(other.from, window.from), to = std::max(other.to, window.to);
  if (other.sigma + to_interval(other) > distance) {
    other.half_edge = -1;  // done with when its turn comes
    window = {window.half_edge,
              window.parent,
              window.origin,
              from,
              to,
              window.image,
              window.sigma,
              keeps_paths_ ? number : -1};
    return false;
  }
  if (keeps_paths_) {
    window.part = other.part;
    windows_.push_back(window);
  }
  Window& grown = windows_[number];
  grown.from = from;
  grown.to = to;
  if (keeps_paths_) grown.part = static_cast<int>(windows_.size()) - 1;
  return true;
}

int Windows::parent_at(int number, double along) const {
  int parent = window(number).parent;
  for (int part = window(number).part; part >= 0; part = window(part).part) {
    if (along >= window(part).from && along <= window(part).to) parent = window(part).parent;
  }
  return parent;
}

void Windows::add(Window window) {
  const double distance = window.sigma + to_interval(window);
  if (is_too_far(distance, window.half_edge)) return;
  if (joins(window, distance)) return;
  int number = static_cast<int>(windows_.size());
  if (free_.empty()) {
    windows_.push_back(window);
  } else {
    number = free_.back();
    free_.pop_back();
    windows_[number] = window;
  }
  waiting_[window.half_edge] = number + 1;
  events_.push({distance, number, -1});
}

void Windows::light_face_from(int number, int face, const Vec3& barycentric) {
  const Vec3 here = surface_.position({face, barycentric});
  for (int corner = 0; corner < 3; ++corner) reach_straight(face, corner, 0.0, -1 - number, here);
  if (is_aimed_ && face == aim_.face)
    reach_target((aim_place_ - here).norm(), -1, -1 - number, face);
  for (int corner = 0; corner < 3; ++corner) {
    if (barycentric[(corner + 2) % 3] == 0.0) continue;  // on this edge itself
    const int across = opposite(3 * face + corner);
    if (across < 0) continue;
    const EdgeFrame inner = frame(3 * face + corner);
    const Vec2 place_here = in_frame(3 * face + corner, inner, barycentric);
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
    const int vertex = triangles_(source.face, corner);
    reached_[vertex] = {true, 0.0, -1, -1 - number, source.face, 0.0};
    if (is_aimed_) {
      for (int k = 0; k < 3; ++k) {
        if (triangles_(aim_.face, k) == vertex)
          reach_target((aim_place_ - place(vertex)).norm(), -1, vertex, aim_.face);
      }
    }
    bend_at(vertex);
    return;
  }
  light_face_from(number, source.face, weights);
  for (int corner = 0; corner < 3; ++corner) {
    if (weights[(corner + 2) % 3] != 0.0) continue;
    const int across = opposite(3 * source.face + corner);
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
  const int across = opposite(facing);
  if (across < 0) return;
  const EdgeFrame inner = frame(facing);
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
  if (to - from <= kNarrow * inner.length) return;
  add({across, -1, vertex, inner.length - to, inner.length - from,
       Vec2(inner.length - inner.apex.x(), -inner.apex.y()), distance});
}

/// Light that comes to a vertex goes on where no shorter way leads past it: at least half a turn
/// from where it came on either side. From a source it goes everywhere.
void Windows::bend_at(int vertex) {
  const Reached reached = reached_[vertex];
  const bool closes = fan_around(vertex);
  const double whole = fan_.back().start + fan_.back().angle, half = std::numbers::pi - kFlat;
  double arrival = 0.0;
  for (const Blade& blade : fan_) {
    if (blade.face == reached.face) arrival = blade.start + reached.arrival;
  }
  const std::vector<Blade> fan = fan_;
  for (const Blade& blade : fan) {
    for (const int corner : {(blade.corner + 1) % 3, (blade.corner + 2) % 3})
      reach_straight(blade.face, corner, reached.distance, vertex, place(vertex));
    if (reached.distance == 0.0) {
      light_blade(blade, vertex, 0.0, 0.0, whole);
    } else if (closes) {
      light_blade(blade, vertex, reached.distance, arrival + half, arrival + whole - half);
      light_blade(blade, vertex, reached.distance, arrival + half - whole, arrival - half);
    } else {
      light_blade(blade, vertex, reached.distance, arrival + half, whole);
      light_blade(blade, vertex, reached.distance, 0.0, arrival - half);
    }
  }
}

void Windows::look_at_target(int number, const EdgeFrame& frame) {
  const Window window = windows_[number];
  const Vec2 target = in_frame(window.half_edge, frame, aim_.barycentric);
  const double crossing = crossing_of(window.image, target), slack = kVisible * frame.length;
  if (crossing < window.from - slack || crossing > window.to + slack) return;
  reach_target(window.sigma + (target - window.image).norm(), number, window.origin, aim_.face);
}

/// Light goes on through the face to the edge on the left or the right of its apex.
void Windows::cross_to(int number, bool to_the_right, const EdgeFrame& frame, double crossing) {
  const Window window = windows_[number];
  const int face = window.half_edge / 3, corner = window.half_edge % 3;
  const int across = opposite(3 * face + (corner + (to_the_right ? 1 : 2)) % 3);
  if (across < 0) return;
  const Vec2 right(frame.length, 0.0);
  const Vec2 first = to_the_right ? frame.apex : Vec2(Vec2::Zero()),
             last = to_the_right ? right : frame.apex;
  const double length = (last - first).norm();
  const Turned turned{first, (last - first) / length};
  const Vec2 image = turned(window.image);
  // Where a place on the entered edge, as seen from the image, appears on the edge beyond.
  const auto hit = [&](double along) {
    return std::clamp(crossing_of(image, turned(Vec2(along, 0.0))), 0.0, length);
  };
  const double from = to_the_right && window.from <= crossing ? 0.0 : hit(window.from);
  const double to = !to_the_right && window.to >= crossing ? length : hit(window.to);
  if (to - from <= kNarrow * length) return;
  // A way through a corner that is shorter than all through the window (Xin and Wang 2009,
  // theorem 3.2).
  const double to_from = window.sigma + (image - Vec2(from, 0.0)).norm(),
               to_to = window.sigma + (image - Vec2(to, 0.0)).norm();
  const int behind = to_the_right ? start(window.half_edge) : end(window.half_edge);
  const Vec2 behind_place = turned(to_the_right ? Vec2(Vec2::Zero()) : right);
  const double side = to_the_right ? to : from, to_side = to_the_right ? to_to : to_from;
  if (is_shadowed(across, from, to, to_from, to_to, length)) return;
  if (to_side * (1.0 - kEqual) > known_distance(behind) + (behind_place - Vec2(side, 0.0)).norm())
    return;
  add({across, number, window.origin, from, to, Vec2(image.x(), std::min(image.y(), 0.0)),
       window.sigma});
}

bool Windows::is_shadowed(int half_edge, double from, double to, double to_from, double to_to,
                          double length) const {
  const double least = 1.0 - kEqual;
  return to_to * least > known_distance(start(half_edge)) + to ||
         to_from * least > known_distance(end(half_edge)) + length - from;
}

void Windows::cross(int number) {
  const Window window = windows_[number];
  const EdgeFrame here = frame(window.half_edge);
  // More is known now than when the window was added.
  const double to_from = window.sigma + (window.image - Vec2(window.from, 0.0)).norm(),
               to_to = window.sigma + (window.image - Vec2(window.to, 0.0)).norm();
  if (is_shadowed(window.half_edge, window.from, window.to, to_from, to_to, here.length)) return;
  if (is_aimed_ && window.half_edge / 3 == aim_.face) look_at_target(number, here);
  const double crossing = crossing_of(window.image, here.apex), slack = kVisible * here.length;
  const double distance = window.sigma + (here.apex - window.image).norm();
  if (crossing >= window.from - slack && crossing <= window.to + slack)
    reach(apex(window.half_edge), {true, distance, number, window.origin, window.half_edge / 3,
                                   angle_between(-here.apex, window.image - here.apex)});
  if (crossing <= window.from + slack) return cross_to(number, true, here, crossing);
  if (crossing >= window.to - slack) return cross_to(number, false, here, crossing);
  // Of all windows on this edge that see the apex, only the one that sees it nearest lights both
  // sides (Chen and Han 1990).
  Best& best = best_[window.half_edge];
  if (best.is_known && distance >= best.distance)
    return cross_to(number, crossing >= best.crossing, here, crossing);
  best = {true, distance, crossing};
  cross_to(number, false, here, crossing);
  cross_to(number, true, here, crossing);
}

void Windows::spread() {
  for (int number = 0; number < static_cast<int>(sources_.size()); ++number) light_from(number);
  while (!events_.empty()) {
    const Event event = events_.top();
    events_.pop();
    if (event.distance > radius_m_) break;
    if (is_aimed_ && target_.is_known && event.distance >= target_.distance) break;
    if (event.window < 0) {
      if (event.distance <= known_distance(event.vertex) * (1.0 + kNews))
        bend_at(event.vertex);  // else a shorter way was found
    } else {
      const int half_edge = windows_[event.window].half_edge;
      if (half_edge >= 0) {
        int& waiting = waiting_[half_edge];
        if (waiting == event.window + 1) waiting = 0;
        cross(event.window);
      }
      if (!keeps_paths_) free_.push_back(event.window);
    }
  }
}

}  // namespace palpation
