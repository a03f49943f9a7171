#include "boundary/outline.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "boundary/guarded_overlay.h"
#include "boundary/reproducer.h"

namespace palpation {

namespace {

constexpr double kGreatestCoordinate = 1e9;
/// The square is a number, with room for slivers.
constexpr double kLeastExtent = 1e-100;

/// A corner and its number in the ring as it was given.
struct Corner {
  ExactPoint point;
  int number;
};

std::string coordinates(const Vec2& point) {
  return "(" + text_of(point.x()) + " " + text_of(point.y()) + ")";
}

/// Whether a walk from a over b to c turns back at b along the way it came.
bool turns_back(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
  return CGAL::collinear(a, b, c) && !CGAL::collinear_are_ordered_along_line(a, b, c);
}

/// Without repeated points and spikes of no width. Nothing if nothing else is left.
std::vector<Corner> cleaned(const ExactRing& ring, Untidy& untidy) {
  std::vector<Corner> path;
  for (const ExactPoint& point : ring) {
    const int number = static_cast<int>(&point - ring.data());
    if (!path.empty() && path.back().point == point) {
      path.back().number = number;
      ++untidy.repeats;
      continue;
    }
    while (path.size() >= 2 && turns_back(path[path.size() - 2].point, path.back().point, point)) {
      path.pop_back();
      ++untidy.spikes;
    }
    if (!path.empty() && path.back().point == point) {
      path.back().number = number;
    } else {
      path.push_back({point, number});
    }
  }
  // The start and the end are where the walk was cut open.
  std::size_t first = 0;
  for (bool changed = true; changed && path.size() - first >= 3;) {
    changed = true;
    if (path.back().point == path[first].point) {
      path.pop_back();
      ++untidy.repeats;
    } else if (turns_back(path[path.size() - 2].point, path.back().point, path[first].point)) {
      path.pop_back();
      ++untidy.spikes;
    } else if (turns_back(path.back().point, path[first].point, path[first + 1].point)) {
      ++first;
      ++untidy.spikes;
    } else {
      changed = false;
    }
  }
  if (path.size() - first < 3) return {};
  return {path.begin() + static_cast<std::ptrdiff_t>(first), path.end()};
}

bool on_segment(const ExactPoint& a, const ExactPoint& b, const ExactPoint& place) {
  return CGAL::collinear(a, place, b) && CGAL::collinear_are_ordered_along_line(a, place, b);
}

/// "edges 0, from (0 0) to (2 2), and 2, from (2 0) to (0 2)": the first two that `are_there`.
std::string names_of_edges(
    const std::vector<Corner>& corners, const Ring& ring,
    const std::function<bool(const ExactPoint&, const ExactPoint&)>& are_there) {
  std::string names = "edges ";
  int found = 0;
  for (std::size_t i = 0; i < corners.size() && found < 2; ++i) {
    if (!are_there(corners[i].point, corners[(i + 1) % corners.size()].point)) continue;
    const auto number = static_cast<std::size_t>(corners[i].number);
    names += std::string(found == 0 ? "" : ", and ") + std::to_string(number) + ", from " +
             coordinates(ring[number]) + " to " + coordinates(ring[(number + 1) % ring.size()]);
    ++found;
  }
  return names;
}

/// What a single ring encloses.
std::vector<ExactPolygon> enclosed_by(const Ring& ring, const std::string& function,
                                      const std::string& name) {
  const ExactRing given = exact_ring(ring, function, name);
  Untidy untidy;
  const std::vector<Corner> corners = cleaned(given, untidy);
  if (corners.empty()) return {};
  ExactRing points;
  for (const Corner& corner : corners) points.push_back(corner.point);
  const auto reproduce = [&] { return well_known_text(std::span(&ring, 1)); };
  return with_overlay(function, {&points}, {}, reproduce, [&](const Overlay& overlay) {
    if (const auto shared = overlay.overlap()) {
      const auto run_there = [&](const ExactPoint& a, const ExactPoint& b) {
        return on_segment(a, b, shared->front()) && on_segment(a, b, shared->back());
      };
      require(false, function, name,
              "must not touch itself along a line, as its " +
                  names_of_edges(corners, ring, run_there) + ", do from " +
                  coordinates(rounded(shared->front())) + " to " +
                  coordinates(rounded(shared->back())));
    }
    const bool positive = overlay.any([](const Winding& winding) { return winding[0] > 0; });
    const bool crosses = overlay.any(
        [&](const Winding& winding) { return winding[0] < (positive ? 0 : -1) || winding[0] > 1; });
    if (const auto place = crosses ? overlay.crossing() : std::nullopt) {
      const auto pass_there = [&](const ExactPoint& a, const ExactPoint& b) {
        return b != *place && on_segment(a, b, *place);
      };
      require(false, function, name,
              "must not cross itself, as its " + names_of_edges(corners, ring, pass_there) +
                  ", do at " + coordinates(rounded(*place)));
    }
    std::vector<ExactPolygon> enclosed =
        overlay.polygons([](const Winding& winding) { return winding[0] != 0; });
    const double expected = std::abs(signed_area({points}));
    require_identity(function, area_of(enclosed), expected, expected);
    return enclosed;
  });
}

/// The holes of one polygon, each as what it encloses.
class Holes {
 public:
  Holes(const PolygonWithHoles& polygon, const std::string& function, const std::string& which)
      : polygon_(polygon), function_(function), which_(which) {
    for (std::size_t i = 0; i < polygon.holes.size(); ++i) {
      holes_.push_back(
          enclosed_by(polygon.holes[i], function, "hole " + std::to_string(i) + which));
    }
  }

  std::vector<ExactPolygon> cut_out_of(const std::vector<ExactPolygon>& outer) const {
    const RingPointers rings = ring_pointers(outer);
    return with_overlay(
        function_, rings, first(holes_.size()), reproducer(), [&](const Overlay& overlay) {
          if (const auto place = overlay.lowest(overlap)) refuse_overlap(*place);
          if (const auto place = overlay.lowest(outside)) refuse_outside(rings, *place);
          std::vector<ExactPolygon> rest =
              overlay.polygons([](const Winding& winding) { return winding[0] > winding[1]; });
          double area_of_holes = 0.0;
          for (const std::vector<ExactPolygon>& hole : holes_) area_of_holes += area_of(hole);
          require_identity(function_, area_of(rest), area_of(outer) - area_of_holes,
                           area_of(outer) + area_of_holes);
          return rest;
        });
  }

 private:
  static bool overlap(const Winding& winding) { return winding[1] > 1; }
  static bool outside(const Winding& winding) { return winding[1] > winding[0]; }
  static bool both(const Winding& winding) { return winding[0] > 0 && winding[1] > 0; }

  std::function<std::string()> reproducer() const {
    return [this] { return well_known_text(std::span(&polygon_, 1)); };
  }

  RingPointers first(std::size_t count) const {
    RingPointers rings;
    for (std::size_t i = 0; i < count; ++i) {
      const RingPointers more = ring_pointers(holes_[i]);
      rings.insert(rings.end(), more.begin(), more.end());
    }
    return rings;
  }

  /// The lowest hole that, with all below it, makes some of the part over those rings.
  std::size_t first_to_make(const Overlay::Part& part, const RingPointers& rings) const {
    std::size_t low = 0;
    for (std::size_t high = holes_.size() - 1; low < high;) {
      const std::size_t middle = (low + high) / 2;
      const bool made = with_overlay(function_, rings, first(middle + 1), reproducer(),
                                     [&](const Overlay& overlay) { return overlay.any(part); });
      (made ? high : low) = made ? middle : middle + 1;
    }
    return low;
  }

  void refuse_overlap(const ExactPoint& place) const {
    const std::size_t second = first_to_make(overlap, {});
    const std::size_t other = first_to_make(both, ring_pointers(holes_[second]));
    require(false, function_,
            "holes " + std::to_string(other) + " and " + std::to_string(second) + which_,
            "must not overlap, as holes do near " + coordinates(rounded(place)));
  }

  void refuse_outside(const RingPointers& outer, const ExactPoint& place) const {
    require(false, function_, "hole " + std::to_string(first_to_make(outside, outer)) + which_,
            "must be inside its outer ring, as a hole is not near " + coordinates(rounded(place)));
  }

  const PolygonWithHoles& polygon_;
  const std::string& function_;
  const std::string& which_;
  std::vector<std::vector<ExactPolygon>> holes_;
};

}  // namespace

ExactRing exact_ring(const Ring& ring, const std::string& function, const std::string& name) {
  ExactRing points;
  points.reserve(ring.size());
  double greatest = 0.0;
  for (const Vec2& point : ring) {
    if (!point.allFinite() || point.cwiseAbs().maxCoeff() > kGreatestCoordinate) {
      require(false, function,
              "corner " + std::to_string(points.size()) + " of " + name + ", " +
                  coordinates(point) + ",",
              point.allFinite() ? "must be within 1e9 m of the origin" : "must be finite");
    }
    greatest = std::max(greatest, point.cwiseAbs().maxCoeff());
    points.emplace_back(point.x(), point.y());
  }
  if (greatest > 0.0 && greatest < kLeastExtent) {
    require(false, function, name,
            "must reach farther than 1e-100 m from the origin, and only reaches " +
                text_of(greatest) + ": its area would be no number");
  }
  return points;
}

Untidy untidy_parts(const Ring& ring, const std::string& function, const std::string& name) {
  const QuietCgal quiet;
  Untidy untidy;
  if (cleaned(exact_ring(ring, function, name), untidy).empty()) return {.has_no_area = true};
  return untidy;
}

std::string which_polygon(std::size_t number, std::size_t count) {
  return count > 1 ? " of polygon " + std::to_string(number) : std::string();
}

std::vector<ExactPolygon> enclosed_by(const PolygonWithHoles& polygon, const std::string& which,
                                      const std::string& function) {
  std::vector<ExactPolygon> outer = enclosed_by(polygon.outer, function, "the outer ring" + which);
  if (polygon.holes.empty()) return outer;
  return Holes(polygon, function, which).cut_out_of(outer);
}

}  // namespace palpation
