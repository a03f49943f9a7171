/// Outlines in the plane of a chart as closed polygons whose nodes move, and where places lie to
/// them.
#pragma once

#include <vector>

#include "base/cross.h"
#include "palpation/base/types.h"

namespace palpation {

/// One closed line: its nodes stand one after the other.
struct NodeLoop {
  int first = 0;
  int count = 0;
  int part = 0;      ///< of the inside, that it bounds; 0 is the one that may have a core
  double turns = 1;  ///< 1 where it runs counter-clockwise, else -1
};

struct OutlineNodes {
  std::vector<Vec2> place;
  std::vector<int> loop_of;
  std::vector<NodeLoop> loops;

  int count() const { return static_cast<int>(place.size()); }
  int next(int node) const {
    const NodeLoop& loop = loops[loop_of[node]];
    return node + 1 < loop.first + loop.count ? node + 1 : loop.first;
  }
  int before(int node) const {
    const NodeLoop& loop = loops[loop_of[node]];
    return node > loop.first ? node - 1 : loop.first + loop.count - 1;
  }
  int parts() const;
  /// Adds a line. Its direction is found from its area.
  void add(const std::vector<Vec2>& line, int part);
};

inline double squared_distance(const Vec2& place, const Vec2& from, const Vec2& to) {
  const Vec2 along = to - from, away = place - from;
  const double square = along.squaredNorm(), ahead = away.dot(along);
  if (ahead <= 0.0) return away.squaredNorm();
  if (ahead >= square) return (place - to).squaredNorm();
  const double beside = cross(along, away);
  return beside * beside / square;
}

/// Whether the piece crosses the ray from the place along x: an odd number of them is inside.
inline bool crosses_ray(const Vec2& place, const Vec2& from, const Vec2& to) {
  const bool falls = from.y() > place.y();
  return falls != (to.y() > place.y()) && falls != (cross(to - from, place - from) > 0.0);
}

inline bool cross_each_other(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return (cross(b - a, c - a) > 0.0) != (cross(b - a, d - a) > 0.0) &&
         (cross(d - c, a - c) > 0.0) != (cross(d - c, b - c) > 0.0);
}

/// What a closed line encloses, positive where it runs counter-clockwise.
double enclosed_area(const std::vector<Vec2>& line);
/// As many places, at equal distances along the line, its first one among them.
std::vector<Vec2> evenly_spaced(const std::vector<Vec2>& line, int count);

/// Whether no two pieces cross.
bool is_simple(const OutlineNodes& outline);

/// Which loop lies in which, of all pairs: what no step without crossings changes but of whole
/// loops, or over one.
std::vector<bool> nesting_of(const OutlineNodes& outline);

/// Where a place lies: the least distance from any piece, and the piece's first node.
struct NearestPiece {
  double square = 0.0;
  int piece = 0;
};
NearestPiece nearest_piece(const OutlineNodes& outline, const Vec2& place);
bool is_inside(const OutlineNodes& outline, const Vec2& place);
/// Distance from the outline, positive inside.
double depth_in(const OutlineNodes& outline, const Vec2& place);

}  // namespace palpation
