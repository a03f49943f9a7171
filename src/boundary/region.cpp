#include "palpation/boundary/region.h"

#include <algorithm>
#include <cmath>

#include "boundary/exact_polygons.h"
#include "boundary/guarded_overlay.h"
#include "boundary/outline.h"
#include "boundary/reproducer.h"

namespace palpation {

namespace {

/// An edge's heights, rounded outwards, to pass over most edges without exact arithmetic.
struct EdgeHeights {
  double low;
  double high;
};

EdgeHeights heights(const ExactPoint& a, const ExactPoint& b) {
  const auto& y_a = a.approx().y();
  const auto& y_b = b.approx().y();
  return {std::min(y_a.inf(), y_b.inf()), std::max(y_a.sup(), y_b.sup())};
}

bool by_area_then_corner(const std::pair<double, ExactPolygon>& a,
                         const std::pair<double, ExactPolygon>& b) {
  if (a.first != b.first) return a.first > b.first;
  return CGAL::compare_xy(a.second.outer.front(), b.second.outer.front()) == CGAL::SMALLER;
}

void sort_holes(std::vector<ExactRing>& holes) {
  std::vector<std::pair<double, ExactPolygon>> sized;
  for (ExactRing& hole : holes) {
    const double hole_area = -signed_area({hole});
    sized.emplace_back(hole_area, ExactPolygon{std::move(hole), {}});
  }
  std::sort(sized.begin(), sized.end(), by_area_then_corner);
  for (std::size_t i = 0; i < holes.size(); ++i) holes[i] = std::move(sized[i].second.outer);
}

std::vector<ExactPolygon> sorted(std::vector<ExactPolygon> polygons) {
  std::vector<std::pair<double, ExactPolygon>> sized;
  for (ExactPolygon& polygon : polygons) {
    sort_holes(polygon.holes);
    const double polygon_area = area_of(std::span(&polygon, 1));
    sized.emplace_back(polygon_area, std::move(polygon));
  }
  std::sort(sized.begin(), sized.end(), by_area_then_corner);
  for (std::size_t i = 0; i < polygons.size(); ++i) polygons[i] = std::move(sized[i].second);
  return polygons;
}

bool odd(int number) { return number % 2 != 0; }

/// What an operation keeps, and its area by the identities from |A|, |B| and |A & B|.
struct Operation {
  std::string name;
  Overlay::Part part;
  double (*area)(double a, double b, double both);
};

bool in_both(const Winding& winding) { return winding[0] > 0 && winding[1] > 0; }

}  // namespace

struct Region::State {
  explicit State(std::vector<ExactPolygon> pieces)
      : polygons(sorted(std::move(pieces))), area(area_of(polygons)) {
    const QuietCgal quiet;
    rings = ring_pointers(polygons);
    for (const ExactRing* ring : rings) {
      for (std::size_t i = 0; i < ring->size(); ++i)
        edge_heights.push_back(heights((*ring)[i], (*ring)[(i + 1) % ring->size()]));
    }
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  static Region region(std::vector<ExactPolygon> pieces) {
    Region made;
    if (!pieces.empty()) made.state_ = std::make_shared<const State>(std::move(pieces));
    return made;
  }

  static Region combine(const Region& a, const Region& b, const Operation& operation) {
    const State& left = *a.state_;
    const State& right = *b.state_;
    return with_overlay(
        operation.name, left.rings, right.rings, [&] { return operands(a, b); },
        [&](const Overlay& overlay) {
          Region made = region(overlay.polygons(operation.part));
          const double expected = operation.area(left.area, right.area, overlay.area(in_both));
          require_identity(operation.name, made.area(), expected, left.area + right.area);
          return made;
        });
  }

  static std::string operands(const Region& a, const Region& b) {
    return well_known_text(a.polygons()) + " and " + well_known_text(b.polygons());
  }

  std::vector<ExactPolygon> polygons;
  double area;
  RingPointers rings;
  std::vector<EdgeHeights> edge_heights;  ///< of all rings in turn
};

Region::Region() {
  static const auto nothing = std::make_shared<const State>(std::vector<ExactPolygon>());
  state_ = nothing;
}

Region::Region(std::span<const PolygonWithHoles> polygons) : Region() {
  std::vector<ExactPolygon> pieces;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    std::vector<ExactPolygon> enclosed =
        enclosed_by(polygons[i], which_polygon(i, polygons.size()), "Region");
    std::move(enclosed.begin(), enclosed.end(), std::back_inserter(pieces));
  }
  if (polygons.size() > 1) {
    pieces = with_overlay(
        "Region", ring_pointers(pieces), {}, [&] { return well_known_text(polygons); },
        [](const Overlay& overlay) {
          const auto inside = [](const Winding& winding) { return winding[0] > 0; };
          std::vector<ExactPolygon> whole = overlay.polygons(inside);
          const double expected = overlay.area(inside);
          require_identity("Region", area_of(whole), expected, expected);
          return whole;
        });
  }
  *this = State::region(std::move(pieces));
}

Region Region::even_odd(std::span<const Ring> rings) {
  std::vector<ExactRing> points;
  for (const Ring& ring : rings)
    points.push_back(exact_ring(ring, "Region::even_odd", "ring " + std::to_string(points.size())));
  RingPointers pointers;
  for (const ExactRing& ring : points) pointers.push_back(&ring);
  return with_overlay(
      "Region::even_odd", pointers, {}, [&] { return well_known_text(rings); },
      [](const Overlay& overlay) {
        const auto inside = [](const Winding& winding) { return odd(winding[0]); };
        Region made = State::region(overlay.polygons(inside));
        const double expected = overlay.area(inside);
        require_identity("Region::even_odd", made.area(), expected, expected);
        return made;
      });
}

std::vector<PolygonWithHoles> Region::polygons() const {
  std::vector<PolygonWithHoles> polygons;
  for (const ExactPolygon& polygon : state_->polygons) polygons.push_back(rounded(polygon));
  return polygons;
}

bool Region::empty() const { return state_->polygons.empty(); }

double Region::area() const { return state_->area; }

bool Region::contains(const Vec2& place) const {
  if (!place.allFinite())
    require(false, "Region::contains", text_of(place.x()) + " " + text_of(place.y()),
            "must be finite");
  const QuietCgal quiet;
  const ExactPoint here(place.x(), place.y());
  bool inside = false;
  std::size_t edge = 0;
  for (const ExactRing* ring : state_->rings) {
    for (std::size_t i = 0; i < ring->size(); ++i, ++edge) {
      const EdgeHeights& span = state_->edge_heights[edge];
      if (place.y() < span.low || place.y() > span.high) continue;
      const ExactPoint& a = (*ring)[i];
      const ExactPoint& b = (*ring)[(i + 1) % ring->size()];
      const bool a_above = CGAL::compare_y(a, here) == CGAL::LARGER;
      const bool b_above = CGAL::compare_y(b, here) == CGAL::LARGER;
      const CGAL::Orientation side = CGAL::orientation(a, b, here);
      if (side == CGAL::COLLINEAR && CGAL::collinear_are_ordered_along_line(a, here, b))
        return true;
      // The ray to the right of the place crosses an edge that runs up on the right, or down with
      // the place on its right.
      if (a_above != b_above && (side == CGAL::LEFT_TURN) == b_above) inside = !inside;
    }
  }
  return inside;
}

Region unite(const Region& a, const Region& b) {
  return Region::State::combine(
      a, b,
      {.name = "unite",
       .part = [](const Winding& winding) { return winding[0] > 0 || winding[1] > 0; },
       .area = [](double left, double right, double both) { return left + right - both; }});
}

Region intersect(const Region& a, const Region& b) {
  return Region::State::combine(
      a, b, {.name = "intersect", .part = in_both, .area = [](double, double, double both) {
               return both;
             }});
}

Region subtract(const Region& a, const Region& b) {
  return Region::State::combine(
      a, b,
      {.name = "subtract",
       .part = [](const Winding& winding) { return winding[0] > 0 && winding[1] == 0; },
       .area = [](double left, double, double both) { return left - both; }});
}

Region symmetric_difference(const Region& a, const Region& b) {
  return Region::State::combine(
      a, b,
      {.name = "symmetric_difference",
       .part = [](const Winding& winding) { return (winding[0] > 0) != (winding[1] > 0); },
       .area = [](double left, double right, double both) { return left + right - 2.0 * both; }});
}

OverlapAreas overlap_areas(const Region& a, const Region& b) {
  const Region::State& left = *a.state_;
  const Region::State& right = *b.state_;
  return with_overlay(
      "overlap_areas", left.rings, right.rings, [&] { return Region::State::operands(a, b); },
      [&](const Overlay& overlay) {
        OverlapAreas areas;
        areas.both_m2 = overlay.area(in_both);
        areas.only_a_m2 =
            overlay.area([](const Winding& winding) { return winding[0] > 0 && winding[1] == 0; });
        areas.only_b_m2 =
            overlay.area([](const Winding& winding) { return winding[0] == 0 && winding[1] > 0; });
        require_identity("overlap_areas", areas.both_m2 + areas.only_a_m2, left.area,
                         left.area + right.area);
        require_identity("overlap_areas", areas.both_m2 + areas.only_b_m2, right.area,
                         left.area + right.area);
        return areas;
      });
}

}  // namespace palpation
