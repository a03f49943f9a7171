/// The nearest of many segments to a place, for places that come one beside the other. Private to this folder.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "palpation/base/types.h"

namespace palpation {

struct Segment {
  Vec2 from;
  Vec2 to;
  double nearest_part(const Vec2& place) const;  ///< from 0 at `from` to 1 at `to`
  double squared_distance(const Vec2& place) const;
};

/// A tree of boxes over the segments in the order given: good when neighbours in that order are neighbours in the plane, as along a
/// boundary.
class NearestSegment {
 public:
  explicit NearestSegment(std::vector<Segment> segments);  ///< at least one

  /// `hint`: the number of a segment that may be near; becomes that of the nearest.
  double distance(const Vec2& place, int& hint) const;

  /// The nearest place on a segment where a step has the length |stretch * step|.
  Vec2 nearest(const Vec2& place, const Eigen::Matrix2d& stretch, int& hint) const;

 private:
  void build(int node, int first, int last);
  /// `squared_distance` of a segment from the place; boxes are no nearer than in the plane, times `shrink`.
  template <typename SquaredDistance>
  void search(const Vec2& place, double shrink, const SquaredDistance& squared_distance, int node, int first, int last, double& best,
              int& nearest) const;

  std::vector<Segment> segments_;
  std::vector<Eigen::AlignedBox2d> boxes_;  ///< node i has the children 2 i + 1 and 2 i + 2, each with half of its segments
};

}  // namespace palpation
