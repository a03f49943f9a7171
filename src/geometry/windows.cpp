#include "geometry/windows.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace palpation {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// Of an edge's length: light this close beside a corner still sees it.
constexpr double kVisible = 1e-10;
/// Of a distance: images of one source that are nearer are one.
constexpr double kSameImage = 1e-11;
/// Light that bends at a vertex need not bend there anew for ways that are shorter by so little.
constexpr double kNews = 1e-9;

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
    : frames_(surface),
      sources_(sources.begin(), sources.end()),
      radius_m_(radius_m),
      keeps_paths_(keeps_paths),
      reached_(static_cast<std::size_t>(surface.vertex_count())),
      best_(3 * static_cast<std::size_t>(surface.face_count())),
      waiting_(3 * static_cast<std::size_t>(surface.face_count())) {}

void Windows::aim_at(const SurfacePoint& target, double at_most_m) {
  target_.emplace(target, frames_.place(target), at_most_m);
}

double Windows::known_distance(int vertex) const {
  const Reached& reached = reached_[vertex];
  return reached.is_known ? reached.distance : kInfinite;
}

bool Windows::is_too_far(double distance, int half_edge) const {
  if (distance > radius_m_) return true;
  if (!target_) return false;
  const double longest = target_->longest();
  if (distance > longest) return true;
  const Vec3 a = frames_.place(frames_.start(half_edge)), b = frames_.place(frames_.end(half_edge));
  return distance + (0.5 * (a + b) - target_->place()).norm() - 0.5 * (b - a).norm() > longest;
}

/// The target may be at this vertex, or be seen from it.
void Windows::see_target_from(int vertex, double distance) {
  if (!target_) return;
  for (int corner = 0; corner < 3; ++corner) {
    if (frames_.corner(target_->face(), corner) == vertex)
      target_->reach(distance + (target_->place() - frames_.place(vertex)).norm(), -1, vertex,
                     target_->face());
  }
}

void Windows::reach(int vertex, const Reached& now) {
  Reached& reached = reached_[vertex];
  if (reached.is_known && now.distance >= reached.distance) return;
  const bool is_news = !reached.is_known || now.distance < reached.distance * (1.0 - kEqualWays);
  reached = now;
  if (is_news && now.distance <= radius_m_ && light_bends_at(vertex))
    events_.push({now.distance, -1, vertex});
  see_target_from(vertex, now.distance);
}

/// A corner of a face, straight through that face from a place in it.
void Windows::reach_straight(int face, int corner, double distance, int origin, const Vec3& from) {
  const int vertex = frames_.corner(face, corner);
  const Vec3 next = frames_.place(frames_.corner(face, (corner + 1) % 3)) - frames_.place(vertex),
             back = from - frames_.place(vertex);
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

void Windows::look_at_target(int number, const EdgeFrame& frame) {
  const Window window = windows_[number];
  const Vec2 target = frames_.in_frame(window.half_edge, frame, target_->barycentric());
  const double crossing = crossing_of(window.image, target), slack = kVisible * frame.length;
  if (crossing < window.from - slack || crossing > window.to + slack) return;
  target_->reach(window.sigma + (target - window.image).norm(), number, window.origin,
                 target_->face());
}

/// Light goes on through the face to the edge on the left or the right of its apex.
void Windows::cross_to(int number, bool to_the_right, const EdgeFrame& frame, double crossing) {
  const Window window = windows_[number];
  const int face = window.half_edge / 3, corner = window.half_edge % 3;
  const int across = frames_.opposite(3 * face + (corner + (to_the_right ? 1 : 2)) % 3);
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
  if (to - from <= kNarrowWindow * length) return;
  // A way through a corner that is shorter than all through the window (Xin and Wang 2009,
  // theorem 3.2).
  const double to_from = window.sigma + (image - Vec2(from, 0.0)).norm(),
               to_to = window.sigma + (image - Vec2(to, 0.0)).norm();
  const int behind = to_the_right ? frames_.start(window.half_edge) : frames_.end(window.half_edge);
  const Vec2 behind_place = turned(to_the_right ? Vec2(Vec2::Zero()) : right);
  const double side = to_the_right ? to : from, to_side = to_the_right ? to_to : to_from;
  if (is_shadowed(across, from, to, to_from, to_to, length)) return;
  if (to_side * (1.0 - kEqualWays) >
      known_distance(behind) + (behind_place - Vec2(side, 0.0)).norm())
    return;
  add({across, number, window.origin, from, to, Vec2(image.x(), std::min(image.y(), 0.0)),
       window.sigma});
}

bool Windows::is_shadowed(int half_edge, double from, double to, double to_from, double to_to,
                          double length) const {
  const double least = 1.0 - kEqualWays;
  return to_to * least > known_distance(frames_.start(half_edge)) + to ||
         to_from * least > known_distance(frames_.end(half_edge)) + length - from;
}

void Windows::cross(int number) {
  const Window window = windows_[number];
  const EdgeFrame here = frames_.frame(window.half_edge);
  // More is known now than when the window was added.
  const double to_from = window.sigma + (window.image - Vec2(window.from, 0.0)).norm(),
               to_to = window.sigma + (window.image - Vec2(window.to, 0.0)).norm();
  if (is_shadowed(window.half_edge, window.from, window.to, to_from, to_to, here.length)) return;
  if (target_ && window.half_edge / 3 == target_->face()) look_at_target(number, here);
  const double crossing = crossing_of(window.image, here.apex), slack = kVisible * here.length;
  const double distance = window.sigma + (here.apex - window.image).norm();
  if (crossing >= window.from - slack && crossing <= window.to + slack)
    reach(frames_.apex(window.half_edge),
          {true, distance, number, window.origin, window.half_edge / 3,
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
    if (target_ && target_->is_behind(event.distance)) break;
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
