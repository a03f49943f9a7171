/// The nearest of many segments to a place, in the plane or in space, for places that come one
/// beside the other.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "palpation/base/types.h"

namespace palpation {

template <int dimension>
struct Segment {
  using Point = Eigen::Matrix<double, dimension, 1>;
  Point from;
  Point to;
  double nearest_part(const Point& place) const;  ///< from 0 at `from` to 1 at `to`
  double squared_distance(const Point& place) const;
};

/// A tree of boxes over the segments in the order given: good when neighbours in that order are
/// neighbours in space, as along a boundary.
template <int dimension>
class NearestSegment {
 public:
  using Point = Eigen::Matrix<double, dimension, 1>;
  using Square = Eigen::Matrix<double, dimension, dimension>;

  explicit NearestSegment(std::vector<Segment<dimension>> segments);  ///< at least one

  /// `hint`: the number of a segment that may be near; becomes that of the nearest.
  double distance(const Point& place, int& hint) const;

  /// The nearest place on a segment where a step has the length |stretch * step|.
  Point nearest(const Point& place, const Square& stretch, int& hint) const;

 private:
  void build(int node, int first, int last);
  /// `squared_distance` of a segment from the place; boxes are no nearer than in space, times
  /// `shrink`.
  template <typename SquaredDistance>
  void search(const Point& place, double shrink, const SquaredDistance& squared_distance, int node,
              int first, int last, double& best, int& nearest) const;

  std::vector<Segment<dimension>> segments_;
  std::vector<Eigen::AlignedBox<double, dimension>>
      boxes_;  ///< node i has the children 2 i + 1 and 2 i + 2, each with half of its segments
};

extern template struct Segment<2>;
extern template struct Segment<3>;
extern template class NearestSegment<2>;
extern template class NearestSegment<3>;

}  // namespace palpation
