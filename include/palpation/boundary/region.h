/// A part of the tissue: polygons with holes, in the coordinates of a chart. Exact: corners of the
/// input are taken as they are, what Booleans add is kept as exact rational points, and only what
/// is handed out is rounded.
///
/// Laws: (1) |A - B| + |A & B| = |A|, |A ^ B| = |A| + |B| - 2 |A & B|, in exact arithmetic; (2) A ^
/// A is empty; (3) polygons() lists outer rings counter-clockwise and holes clockwise, none
/// self-crossing, none repeating its first point, by falling area, then by lowest first corner; (4)
/// equal regions list equal polygons: pieces that meet at a point only are apart, a ring visits no
/// point twice, has no straight corner and starts at its lowest corner (u before v). Rings may
/// share corners with others.
///
/// Outlines whose edges cross, run along each other or crowd at one point more than 500,000 times
/// are refused with InvalidInput before any work is done. Every result's area is held against those
/// that it is made of; should the arithmetic contradict itself, NumericalError brings the operands
/// as WKT. Time and memory grow with corners and crossings (20 s and 2 GB a million), the stack
/// does not. Threads may share regions.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "palpation/base/types.h"

namespace palpation {

using Ring = std::vector<Vec2>;

struct PolygonWithHoles {
  Ring outer;
  std::vector<Ring> holes;
};

class Region {
 public:
  /// Nothing.
  Region();

  /// The polygons' union. Rings may run either way, repeat points in sequence and touch themselves
  /// and others at points; what has no area is dropped, spikes of no width too (outline_repairs.h
  /// counts them). Throws InvalidInput, naming ring, edges and place, if a coordinate is not finite
  /// or beyond 1e9 m, if a ring reaches no farther than 1e-100 m from the origin, crosses itself or
  /// touches itself along a line, if a hole is not inside its outer ring, or if holes overlap. Edge
  /// i of a ring runs from corner i to the next, counted from 0.
  explicit Region(std::span<const PolygonWithHoles> polygons);

  /// What is inside an odd number of the rings: the meaning of nested level lines, and of outlines
  /// drawn by hand. Any rings are welcome. Throws InvalidInput for coordinates as above.
  static Region even_odd(std::span<const Ring> rings);

  std::vector<PolygonWithHoles> polygons() const;  ///< rounded to doubles
  bool empty() const;
  double area() const;                     ///< m2 in the chart, correct to the last place or so
  bool contains(const Vec2& place) const;  ///< the border counts as inside

  friend Region unite(const Region& a, const Region& b);
  friend Region intersect(const Region& a, const Region& b);
  friend Region subtract(const Region& a, const Region& b);
  friend Region symmetric_difference(const Region& a, const Region& b);
  friend struct OverlapAreas overlap_areas(const Region& a, const Region& b);

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

Region unite(const Region& a, const Region& b);
Region intersect(const Region& a, const Region& b);
Region subtract(const Region& a, const Region& b);
Region symmetric_difference(const Region& a, const Region& b);

/// The areas of a & b, a - b and b - a in the chart, m2, from one overlay and without making these
/// regions.
struct OverlapAreas {
  double both_m2 = 0.0;
  double only_a_m2 = 0.0;
  double only_b_m2 = 0.0;
};
OverlapAreas overlap_areas(const Region& a, const Region& b);

}  // namespace palpation
