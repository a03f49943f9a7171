/// Windows of light that fall from sources through edges into unfolded faces: the state of a search
/// for shortest paths.
#pragma once

#include <optional>
#include <queue>
#include <span>
#include <vector>

#include "geometry/face_frames.h"
#include "geometry/light_target.h"
#include "geometry/unfolding.h"
#include "geometry/window.h"
#include "geometry/zeroed_array.h"
#include "palpation/geometry/surface.h"

namespace palpation {

class Windows {
 public:
  Windows(const Surface& surface, std::span<const SurfacePoint> sources, double radius_m,
          bool keeps_paths);

  /// Only ways to this place count, and only those no longer than at_most_m.
  void aim_at(const SurfacePoint& target, double at_most_m);
  void spread();

  const Reached& vertex(int vertex) const { return reached_[vertex]; }
  /// How the place aimed at is reached.
  const Reached& target() const { return target_->reached(); }
  const Window& window(int number) const { return windows_[number]; }
  /// The window that the light at this place of a window's half-edge came through before.
  int parent_at(int number, double along) const;
  const SurfacePoint& source(int number) const { return sources_[number]; }

  const FaceFrames& frames() const { return frames_; }

 private:
  struct Event {
    double distance;
    int window;  // -1: light bends at the vertex
    int vertex;
    bool operator>(const Event& other) const {
      return distance != other.distance ? distance > other.distance
             : window != other.window   ? window > other.window
                                        : vertex > other.vertex;
    }
  };
  /// The window that sees a face's corner best through the edge on the other side.
  struct Best {
    bool is_known;
    double distance;
    double crossing;
  };

  double known_distance(int vertex) const;

  void light_from(int number);
  void light_face_from(int number, int face, const Vec3& barycentric);
  void bend_at(int vertex);
  void cross(int number);
  void cross_to(int number, bool to_the_right, const EdgeFrame& frame, double crossing);
  void look_at_target(int number, const EdgeFrame& frame);
  void reach(int vertex, const Reached& now);
  void reach_straight(int face, int corner, double distance, int origin, const Vec3& from);
  void light_blade(const Blade& blade, int vertex, double distance, double first, double last);
  void see_target_from(int vertex, double distance);
  bool light_bends_at(int vertex) const;
  bool is_shadowed(int half_edge, double from, double to, double to_from, double to_to,
                   double length) const;
  bool is_too_far(double distance, int half_edge) const;
  void add(Window window);
  bool joins(Window& window, double distance);

  FaceFrames frames_;
  std::vector<SurfacePoint> sources_;
  double radius_m_;
  bool keeps_paths_;
  std::optional<LightTarget> target_;
  ZeroedArray<Reached> reached_;
  ZeroedArray<Best> best_;
  ZeroedArray<int>
      waiting_;  // 1 + the last window added to a half-edge that is still to be crossed
  std::vector<Window> windows_;
  std::vector<int> free_;
  mutable Fan fan_;
  std::priority_queue<Event, std::vector<Event>, std::greater<>> events_;
};

}  // namespace palpation
