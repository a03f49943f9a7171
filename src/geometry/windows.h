/// Windows of light that fall from sources through edges into unfolded faces: the state of a search
/// for shortest paths.
#pragma once

#include <queue>
#include <span>
#include <vector>

#include "geometry/unfolding.h"
#include "geometry/zeroed_array.h"
#include "palpation/geometry/surface.h"

namespace palpation {

/// Half-edge 3 f + i in the plane of its face f: it runs from the origin to (length, 0), and the
/// third corner is at apex, above it.
struct EdgeFrame {
  double length;
  Vec2 apex;
};

/// The part [from, to] of a half-edge through which light falls into its face, straight from
/// `image` (not above the edge), which is sigma away from the source.
struct Window {
  int half_edge;
  int parent;  // the window that it is a part of, one face before; -1: the face before holds the
               // origin
  int origin;  // a vertex that light bends at, or -1 - the source's number
  double from, to;
  Vec2 image;
  double sigma;
  int part = -1;  // another window that was made one with this and keeps its own parent; it may
                  // have such a part in turn
};

/// How a vertex is reached.
struct Reached {
  bool is_known;
  double distance;
  int window;  // through this one; -1: straight from the origin along an edge or through `face`
  int origin;  // as a window's
  int face;
  double arrival;  // of a vertex: the angle in the face from its next corner to where the light
                   // comes from
};

class Windows {
 public:
  Windows(const Surface& surface, std::span<const SurfacePoint> sources, double radius_m,
          bool keeps_paths);

  /// Only ways to this place count, and only those no longer than at_most_m.
  void aim_at(const SurfacePoint& target, double at_most_m);
  void spread();

  const Reached& vertex(int vertex) const { return reached_[vertex]; }
  const Reached& target() const { return target_; }
  const Window& window(int number) const { return windows_[number]; }
  /// The window that the light at this place of a window's half-edge came through before.
  int parent_at(int number, double along) const;
  const SurfacePoint& source(int number) const { return sources_[number]; }

  EdgeFrame frame(int half_edge) const;
  /// A point of the half-edge's face in its frame.
  Vec2 in_frame(int half_edge, const EdgeFrame& frame, const Vec3& barycentric) const;
  /// The half-edge on the other side, -1 at a border.
  int opposite(int half_edge) const;

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

  int start(int half_edge) const { return triangles_(half_edge / 3, half_edge % 3); }
  int end(int half_edge) const { return triangles_(half_edge / 3, (half_edge % 3 + 1) % 3); }
  int apex(int half_edge) const { return triangles_(half_edge / 3, (half_edge % 3 + 2) % 3); }
  Vec3 place(int vertex) const { return vertices_.row(vertex); }
  double known_distance(int vertex) const;

  void light_from(int number);
  void light_face_from(int number, int face, const Vec3& barycentric);
  /// The faces around a vertex, counter-clockwise; where there is a border, from it.
  struct Blade {
    int face, corner;
    double start, angle;  // the face covers so much, from its edge to the next corner
  };
  bool fan_around(int vertex) const;  // whether it closes; in fan_
  void bend_at(int vertex);
  void cross(int number);
  void cross_to(int number, bool to_the_right, const EdgeFrame& frame, double crossing);
  void look_at_target(int number, const EdgeFrame& frame);
  void reach(int vertex, const Reached& now);
  void reach_straight(int face, int corner, double distance, int origin, const Vec3& from);
  void light_blade(const Blade& blade, int vertex, double distance, double first, double last);
  void reach_target(double distance, int window, int origin, int face);
  bool light_bends_at(int vertex) const;
  bool is_shadowed(int half_edge, double from, double to, double to_from, double to_to,
                   double length) const;
  bool is_too_far(double distance, int half_edge) const;
  void add(Window window);
  bool joins(Window& window, double distance);

  const Surface& surface_;
  const Points& vertices_;
  const Triangles& triangles_;
  std::vector<SurfacePoint> sources_;
  double radius_m_;
  bool keeps_paths_;
  bool is_aimed_ = false;
  SurfacePoint aim_;
  Vec3 aim_place_ = Vec3::Zero();
  double at_most_m_ = 0.0;
  Reached target_{};
  ZeroedArray<Reached> reached_;
  ZeroedArray<Best> best_;
  ZeroedArray<int>
      waiting_;  // 1 + the last window added to a half-edge that is still to be crossed
  std::vector<Window> windows_;
  std::vector<int> free_;
  mutable std::vector<Blade> fan_;
  std::priority_queue<Event, std::vector<Event>, std::greater<>> events_;
};

}  // namespace palpation
