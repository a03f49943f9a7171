#include "palpation/boundary/region.h"

#include <CGAL/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "boundary/crossings.h"
#include "boundary/exact_polygons.h"
#include "boundary/overlay.h"
#include "boundary/quiet_cgal.h"
#include "palpation/base/error.h"

namespace palpation {

namespace {

/// An overlay takes about 2 kB a crossing.
constexpr long kMostCrossings = 500'000;
constexpr double kGreatestCoordinate = 1e9;
constexpr std::size_t kLongestMessage = 20'000;

using RingPointers = std::vector<const ExactRing*>;

RingPointers pointers(std::span<const ExactPolygon> polygons) {
  RingPointers rings;
  for (const ExactPolygon& polygon : polygons) {
    rings.push_back(&polygon.outer);
    for (const ExactRing& hole : polygon.holes) rings.push_back(&hole);
  }
  return rings;
}

RingPointers pointers(std::span<const ExactRing> rings) {
  RingPointers all;
  for (const ExactRing& ring : rings) all.push_back(&ring);
  return all;
}

std::string coordinates(const Vec2& point) { return text_of(point.x()) + " " + text_of(point.y()); }

/// Rings as WKT, to reproduce a failure with.
std::string wkt_of(std::span<const ExactRing* const> rings) {
  std::string text = "MULTILINESTRING(";
  for (const ExactRing* ring : rings) {
    text += text.back() == '(' ? "(" : ",(";
    for (const ExactPoint& point : *ring) text += coordinates(rounded(point)) + ",";
    text += (ring->empty() ? std::string() : coordinates(rounded(ring->front()))) + ")";
    if (text.size() > kLongestMessage) return text + " ... cut";
  }
  return text + ")";
}

/// Builds the overlay of two layers of rings and makes something of it; whatever CGAL throws comes out as NumericalError with the rings.
template <typename Make>
auto with_overlay(const std::string& function, const RingPointers& first, const RingPointers& second, Make make) {
  RingPointers all = first;
  all.insert(all.end(), second.begin(), second.end());
  require(cross_at_most(kMostCrossings, all), function, "the rings' edges",
          "may cross at most " + std::to_string(kMostCrossings) + " times");
  const QuietCgal quiet;
  const auto failed = [&](const std::exception& error) {
    return NumericalError(function + ": " + error.what() + " for " + wkt_of(first) + " and " + wkt_of(second));
  };
  try {
    return make(Overlay(first, second));
  } catch (const CGAL::Failure_exception& error) {
    throw failed(error);
  } catch (const NumericalError& error) {
    throw failed(error);
  }
}

void require_usable(const Ring& ring, const std::string& function) {
  for (const Vec2& point : ring) {
    if (point.cwiseAbs().maxCoeff() <= kGreatestCoordinate && point.allFinite()) continue;
    require(point.allFinite(), function, coordinates(point), "must be finite");
    require(false, function, coordinates(point), "must be within 1e9 m of the origin");
  }
}

ExactRing exact_ring(const Ring& ring) {
  ExactRing points;
  points.reserve(ring.size());
  for (const Vec2& point : ring) points.push_back(exact(point));
  return points;
}

/// Whether a walk from a over b to c turns back at b along the way it came, or stops there.
bool turns_back(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
  return a == b || b == c || (CGAL::collinear(a, b, c) && !CGAL::collinear_are_ordered_along_line(a, b, c));
}

/// Without repeated points and spikes of no width.
ExactRing cleaned(const ExactRing& ring) {
  std::vector<ExactPoint> path;
  for (const ExactPoint& point : ring) {
    while (path.size() >= 2 && turns_back(path[path.size() - 2], path.back(), point)) path.pop_back();
    if (path.empty() || path.back() != point) path.push_back(point);
  }
  // The start and the end are where the walk was cut open.
  std::size_t first = 0;
  for (bool changed = true; changed && path.size() - first >= 3;) {
    changed = true;
    if (turns_back(path[path.size() - 2], path.back(), path[first])) {
      path.pop_back();
    } else if (turns_back(path.back(), path[first], path[first + 1])) {
      ++first;
    } else {
      changed = false;
    }
  }
  if (path.size() - first < 3) return {};
  return {path.begin() + static_cast<std::ptrdiff_t>(first), path.end()};
}

std::string where(const std::optional<Vec2>& point) { return point ? " at (" + coordinates(*point) + ")" : ""; }

/// What a single ring encloses, whichever way it runs. Pinched rings are cut at the pinch.
std::vector<ExactPolygon> enclosed_by(const Ring& ring, const std::string& function) {
  require_usable(ring, function);
  const ExactRing points = cleaned(exact_ring(ring));
  if (points.empty()) return {};
  return with_overlay(function, {&points}, {}, [&](const Overlay& overlay) {
    require(!overlay.overlap(), function, "the ring", "must not touch itself along a line, as it does" + where(overlay.overlap()));
    const bool positive = overlay.any([](const Winding& winding) { return winding[0] > 0; });
    const bool crosses = overlay.any([&](const Winding& winding) { return winding[0] < (positive ? 0 : -1) || winding[0] > 1; });
    require(!crosses, function, "the ring", "must not cross itself, as it does" + where(overlay.meeting()));
    return overlay.polygons([](const Winding& winding) { return winding[0] != 0; });
  });
}

std::vector<ExactPolygon> enclosed_by(const PolygonWithHoles& polygon, const std::string& function) {
  std::vector<ExactPolygon> outer = enclosed_by(polygon.outer, function);
  std::vector<ExactPolygon> holes;
  for (const Ring& ring : polygon.holes) {
    std::vector<ExactPolygon> hole = enclosed_by(ring, function);
    std::move(hole.begin(), hole.end(), std::back_inserter(holes));
  }
  if (holes.empty()) return outer;
  return with_overlay(function, pointers(outer), pointers(holes), [&](const Overlay& overlay) {
    require(!overlay.any([](const Winding& winding) { return winding[1] > 1; }), function, "holes", "must not overlap");
    require(!overlay.any([](const Winding& winding) { return winding[1] > winding[0]; }), function, "a hole",
            "must be inside its outer ring");
    return overlay.polygons([](const Winding& winding) { return winding[0] > winding[1]; });
  });
}

Ring rounded_ring(const ExactRing& ring) {
  Ring points;
  for (const ExactPoint& point : ring) points.push_back(rounded(point));
  return points;
}

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

bool by_area_then_corner(const std::pair<double, ExactPolygon>& a, const std::pair<double, ExactPolygon>& b) {
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
    const double polygon_area = area(polygon);
    sized.emplace_back(polygon_area, std::move(polygon));
  }
  std::sort(sized.begin(), sized.end(), by_area_then_corner);
  for (std::size_t i = 0; i < polygons.size(); ++i) polygons[i] = std::move(sized[i].second);
  return polygons;
}

double area_of(std::span<const ExactPolygon> polygons) {
  std::vector<ExactRing> rings;
  for (const ExactRing* ring : pointers(polygons)) rings.push_back(*ring);
  return signed_area(rings);
}

bool odd(int number) { return number % 2 != 0; }

/// What an operation keeps, and its area by the identities from |A|, |B| and |A & B|.
struct Operation {
  std::string name;
  Overlay::Part part;
  double (*area)(double a, double b, double both);
};

bool in_both(const Winding& winding) { return winding[0] > 0 && winding[1] > 0; }

void require_identity(const std::string& function, double area, double expected, double operands) {
  // Each area is rounded once, so this only ever fails if an overlay is wrong.
  if (std::abs(area - expected) <= 1e-14 * operands) return;
  throw NumericalError(function + ": the area " + text_of(area) + " m2 contradicts the operands' areas, which give " + text_of(expected) +
                       " m2");
}

}  // namespace

struct Region::State {
  explicit State(std::vector<ExactPolygon> pieces) : polygons(sorted(std::move(pieces))), area(area_of(polygons)) {
    const QuietCgal quiet;
    rings = pointers(polygons);
    for (const ExactRing* ring : rings) {
      for (std::size_t i = 0; i < ring->size(); ++i) edge_heights.push_back(heights((*ring)[i], (*ring)[(i + 1) % ring->size()]));
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
    return with_overlay(operation.name, left.rings, right.rings, [&](const Overlay& overlay) {
      Region made = region(overlay.polygons(operation.part));
      require_identity(operation.name, made.area(), operation.area(left.area, right.area, overlay.area(in_both)), left.area + right.area);
      return made;
    });
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
  for (const PolygonWithHoles& polygon : polygons) {
    std::vector<ExactPolygon> enclosed = enclosed_by(polygon, "Region");
    std::move(enclosed.begin(), enclosed.end(), std::back_inserter(pieces));
  }
  if (polygons.size() > 1) {
    pieces = with_overlay("Region", pointers(pieces), {},
                          [](const Overlay& overlay) { return overlay.polygons([](const Winding& winding) { return winding[0] > 0; }); });
  }
  *this = State::region(std::move(pieces));
}

Region Region::even_odd(std::span<const Ring> rings) {
  std::vector<ExactRing> points;
  for (const Ring& ring : rings) {
    require_usable(ring, "Region::even_odd");
    points.push_back(exact_ring(ring));
  }
  return with_overlay("Region::even_odd", pointers(points), {}, [](const Overlay& overlay) {
    return State::region(overlay.polygons([](const Winding& winding) { return odd(winding[0]); }));
  });
}

std::vector<PolygonWithHoles> Region::polygons() const {
  std::vector<PolygonWithHoles> polygons;
  for (const ExactPolygon& polygon : state_->polygons) {
    PolygonWithHoles& out = polygons.emplace_back();
    out.outer = rounded_ring(polygon.outer);
    for (const ExactRing& hole : polygon.holes) out.holes.push_back(rounded_ring(hole));
  }
  return polygons;
}

bool Region::empty() const { return state_->polygons.empty(); }

double Region::area() const { return state_->area; }

bool Region::contains(const Vec2& place) const {
  require_usable({place}, "Region::contains");
  const QuietCgal quiet;
  const ExactPoint here = exact(place);
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
      if (side == CGAL::COLLINEAR && CGAL::collinear_are_ordered_along_line(a, here, b)) return true;
      // The ray to the right of the place crosses an edge that runs up on the right, or down with the place on its right.
      if (a_above != b_above && (side == CGAL::LEFT_TURN) == b_above) inside = !inside;
    }
  }
  return inside;
}

Region unite(const Region& a, const Region& b) {
  return Region::State::combine(a, b,
                                {.name = "unite",
                                 .part = [](const Winding& winding) { return winding[0] > 0 || winding[1] > 0; },
                                 .area = [](double left, double right, double both) { return left + right - both; }});
}

Region intersect(const Region& a, const Region& b) {
  return Region::State::combine(a, b, {.name = "intersect", .part = in_both, .area = [](double, double, double both) { return both; }});
}

Region subtract(const Region& a, const Region& b) {
  return Region::State::combine(a, b,
                                {.name = "subtract",
                                 .part = [](const Winding& winding) { return winding[0] > 0 && winding[1] == 0; },
                                 .area = [](double left, double, double both) { return left - both; }});
}

Region symmetric_difference(const Region& a, const Region& b) {
  return Region::State::combine(a, b,
                                {.name = "symmetric_difference",
                                 .part = [](const Winding& winding) { return (winding[0] > 0) != (winding[1] > 0); },
                                 .area = [](double left, double right, double both) { return left + right - 2.0 * both; }});
}

OverlapAreas overlap_areas(const Region& a, const Region& b) {
  const Region::State& left = *a.state_;
  const Region::State& right = *b.state_;
  return with_overlay("overlap_areas", left.rings, right.rings, [&](const Overlay& overlay) {
    OverlapAreas areas;
    areas.both_m2 = overlay.area(in_both);
    areas.only_a_m2 = overlay.area([](const Winding& winding) { return winding[0] > 0 && winding[1] == 0; });
    areas.only_b_m2 = overlay.area([](const Winding& winding) { return winding[0] == 0 && winding[1] > 0; });
    require_identity("overlap_areas", areas.both_m2 + areas.only_a_m2, left.area, left.area + right.area);
    require_identity("overlap_areas", areas.both_m2 + areas.only_b_m2, right.area, left.area + right.area);
    return areas;
  });
}

}  // namespace palpation
