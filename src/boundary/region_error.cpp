#include "palpation/boundary/region_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "boundary/tissue_area.h"
#include "boundary/tissue_ruler.h"
#include "geometry/nearest_segment.h"
#include "palpation/base/error.h"

namespace palpation {

namespace {

constexpr int kSamples = 4000;

void add_segments(const Ring& ring, std::vector<Segment<2>>& segments) {
  for (std::size_t i = 0; i < ring.size(); ++i)
    segments.push_back({ring[i], ring[(i + 1) % ring.size()]});
}

std::vector<Segment<2>> boundary_of(const Region& region) {
  std::vector<Segment<2>> segments;
  for (const PolygonWithHoles& polygon : region.polygons()) {
    add_segments(polygon.outer, segments);
    for (const Ring& hole : polygon.holes) add_segments(hole, segments);
  }
  return segments;
}

/// Distances from one boundary to another.
struct Gap {
  double greatest = 0.0;
  double integral = 0.0;  ///< along the boundary
  double length = 0.0;
};

/// Lengths where the chart keeps them.
struct InChart {
  double length(const Vec2& from, const Vec2& to) const { return (to - from).norm(); }
  double distance(const Vec2& place, const NearestSegment<2>& boundary, int& hint) const {
    return boundary.distance(place, hint);
  }
};

/// Lengths on tissue that the chart stretches: the nearest place by the stretch where one is, then
/// the way there through all faces.
struct OnTissue {
  TissueRuler ruler;
  double length(const Vec2& from, const Vec2& to) const { return ruler.length(from, to); }
  double distance(const Vec2& place, const NearestSegment<2>& boundary, int& hint) const {
    return ruler.length(place, boundary.nearest(place, ruler.stretch_at(place), hint));
  }
};

/// Each segment in equal pieces, none longer than asked; the integral by the trapezoidal rule.
template <typename Measure>
Gap gap(const std::vector<Segment<2>>& boundary, const NearestSegment<2>& other,
        const Measure& measure) {
  Gap total;
  for (const Segment<2>& segment : boundary)
    total.length += measure.length(segment.from, segment.to);
  const double piece_length = std::max(total.length / kSamples, std::numeric_limits<double>::min());
  int hint = 0;
  for (const Segment<2>& segment : boundary) {
    const double length = measure.length(segment.from, segment.to);
    const int pieces = std::max(1, static_cast<int>(std::ceil(length / piece_length)));
    double last = measure.distance(segment.from, other, hint);
    total.greatest = std::max(total.greatest, last);
    for (int piece = 1; piece <= pieces; ++piece) {
      const double part = static_cast<double>(piece) / pieces;
      const double here =
          measure.distance((1.0 - part) * segment.from + part * segment.to, other, hint);
      total.greatest = std::max(total.greatest, here);
      total.integral += 0.5 * (last + here) * length / pieces;
      last = here;
    }
  }
  return total;
}

template <typename Measure>
void add_distances(const Region& estimate, const Region& truth, const Measure& measure,
                   RegionError& error) {
  const std::vector<Segment<2>> a = boundary_of(estimate);
  const std::vector<Segment<2>> b = boundary_of(truth);
  const Gap from_a = gap(a, NearestSegment<2>(b), measure);
  const Gap from_b = gap(b, NearestSegment<2>(a), measure);
  error.hausdorff_m = std::max(from_a.greatest, from_b.greatest);
  // Rounded to doubles, the tiniest of regions has a boundary of no length: then there is one
  // distance only.
  const double length = from_a.length + from_b.length;
  error.mean_distance_m =
      length > 0.0 ? (from_a.integral + from_b.integral) / length : *error.hausdorff_m;
}

OverlapAreas areas_on_tissue(const Surface& surface, const Region& a, const Region& b) {
  if (surface.is_planar()) return overlap_areas(a, b);
  return {tissue_area(surface, intersect(a, b)), tissue_area(surface, subtract(a, b)),
          tissue_area(surface, subtract(b, a))};
}

}  // namespace

RegionError compare(const Surface& surface, const Region& estimate, const Region& truth) {
  const bool isometric = surface.chart().isometric;
  const OverlapAreas areas = areas_on_tissue(surface, estimate, truth);
  RegionError error;
  error.missed_m2 = areas.only_b_m2;
  error.extra_m2 = areas.only_a_m2;
  error.symmetric_difference_m2 = error.missed_m2 + error.extra_m2;
  if (estimate.empty() && truth.empty()) return error;
  const double sum = 2.0 * areas.both_m2 + error.symmetric_difference_m2;
  // Slivers thinner than the least double have areas of zero, and still are what they are.
  error.dice = sum > 0.0 ? 2.0 * areas.both_m2 / sum
                         : (symmetric_difference(estimate, truth).empty() ? 1.0 : 0.0);
  if (estimate.empty() || truth.empty()) return error;
  if (isometric)
    add_distances(estimate, truth, InChart(), error);
  else
    add_distances(estimate, truth, OnTissue{TissueRuler(surface)}, error);
  return error;
}

}  // namespace palpation
