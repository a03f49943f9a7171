#include "boundary/overlay.h"

#include <CGAL/Arr_consolidated_curve_data_traits_2.h>
#include <CGAL/Arr_extended_dcel.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "palpation/base/error.h"

namespace palpation {

namespace {

/// Each curve carries the number of its segment; where segments overlap in part, all numbers are
/// kept.
using SegmentTraits = CGAL::Arr_segment_traits_2<ExactKernel>;
using Traits = CGAL::Arr_consolidated_curve_data_traits_2<SegmentTraits, int>;
using Arrangement = CGAL::Arrangement_2<Traits, CGAL::Arr_extended_dcel<Traits, int, int, int>>;

/// The edges of all rings between the same two corners, as one: the time that CGAL takes for equal
/// segments grows with the cube of their number.
struct Segment {
  const ExactPoint* low;  ///< x before y
  const ExactPoint* high;
  Winding step{0, 0};  ///< what they add to the windings on the left of the way from low to high
  int rings = 1;
};

void add_edges(const ExactRing& ring, int layer, std::vector<Segment>& segments) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const ExactPoint& from = ring[i];
    const ExactPoint& to = ring[i + 1 < ring.size() ? i + 1 : 0];
    const CGAL::Comparison_result order = CGAL::compare_xy(from, to);
    if (order == CGAL::EQUAL) continue;
    const bool runs_right = order == CGAL::SMALLER;
    Segment& segment = segments.emplace_back(
        Segment{.low = runs_right ? &from : &to, .high = runs_right ? &to : &from});
    segment.step[layer] = runs_right ? 1 : -1;
  }
}

using Key = std::array<double, 4>;

/// Equal points, given as doubles or evaluated, have equal bounds.
Key key_of(const Segment& segment) {
  const auto& low = segment.low->approx();
  const auto& high = segment.high->approx();
  return {low.x().inf(), low.y().inf(), high.x().inf(), high.y().inf()};
}

std::vector<Segment> merged(const std::vector<Segment>& edges) {
  std::vector<std::pair<Key, std::size_t>> order;
  order.reserve(edges.size());
  for (const Segment& edge : edges) order.emplace_back(key_of(edge), order.size());
  std::sort(order.begin(), order.end());
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Segment& edge = edges[order[i].second];
    const bool repeats = i > 0 && order[i].first == order[i - 1].first &&
                         *edge.low == *segments.back().low && *edge.high == *segments.back().high;
    if (!repeats) {
      segments.push_back(edge);
      continue;
    }
    for (int layer = 0; layer < 2; ++layer) segments.back().step[layer] += edge.step[layer];
    ++segments.back().rings;
  }
  return segments;
}

Arrangement arrangement_of(const std::vector<Segment>& segments) {
  std::vector<Traits::X_monotone_curve_2> curves;
  curves.reserve(segments.size());
  for (const Segment& segment : segments) {
    curves.emplace_back(SegmentTraits::X_monotone_curve_2(*segment.low, *segment.high),
                        static_cast<int>(curves.size()));
  }
  Arrangement arrangement;
  CGAL::insert(arrangement, curves.begin(), curves.end());
  return arrangement;
}

template <typename Iterator>
int number_elements(Iterator first, Iterator last) {
  int count = 0;
  for (; first != last; ++first) first->set_data(count++);
  return count;
}

/// Cuts a closed walk wherever it comes back to a corner, so that no ring visits a point twice.
std::vector<std::vector<int>> split_at_repeats(const std::vector<int>& walk,
                                               std::vector<int>& place_on_path) {
  std::vector<std::vector<int>> rings;
  std::vector<int> path;
  for (const int corner : walk) {
    const int place = place_on_path[corner];
    if (place >= 0) {
      rings.emplace_back(path.begin() + place, path.end());
      for (const int cut : rings.back()) place_on_path[cut] = -1;
      path.resize(place);
    }
    place_on_path[corner] = static_cast<int>(path.size());
    path.push_back(corner);
  }
  for (const int corner : path) place_on_path[corner] = -1;
  rings.push_back(std::move(path));
  return rings;
}

bool is_lower(const ExactPoint& a, const ExactPoint& b) {
  return CGAL::compare_xy(a, b) == CGAL::SMALLER;
}

/// The ring without straight corners, from its lowest corner, its points evaluated.
ExactRing normal_form(const std::vector<int>& corners, const std::vector<ExactPoint>& points) {
  ExactRing ring;
  const std::size_t count = corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    const ExactPoint& before = points[corners[(i + count - 1) % count]];
    const ExactPoint& here = points[corners[i]];
    if (!CGAL::collinear(before, here, points[corners[(i + 1) % count]])) ring.push_back(here);
  }
  if (ring.size() < 3)
    throw NumericalError("Overlay: a ring of " + std::to_string(count) + " corners has no area");
  std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end(), is_lower), ring.end());
  for (const ExactPoint& point : ring) point.exact();
  return ring;
}

/// At the lowest corner a ring without repeats turns the way it runs.
bool runs_counter_clockwise(const ExactRing& normal) {
  return CGAL::orientation(normal.back(), normal[0], normal[1]) == CGAL::LEFT_TURN;
}

void take_lower(const ExactPoint& point, std::optional<ExactPoint>& lowest) {
  if (!lowest || is_lower(point, *lowest)) lowest = point;
}

/// Order of the half-edges, and where each face's begin in it.
void sort_by_face(std::span<const int> face_of, int face_count, std::vector<int>& first,
                  std::vector<int>& order) {
  first.assign(face_count + 1, 0);
  for (const int face : face_of) ++first[face + 1];
  for (int face = 0; face < face_count; ++face) first[face + 1] += first[face];
  order.resize(face_of.size());
  std::vector<int> next = first;
  for (std::size_t i = 0; i < face_of.size(); ++i) order[next[face_of[i]]++] = static_cast<int>(i);
}

}  // namespace

/// Twice the areas on the left of edges that count so many times, in doubles, and how far rounding
/// may have moved them.
struct Overlay::DoubledAreas {
  std::array<double, 2> sum{0.0, 0.0};
  std::array<double, 2> rounding{0.0, 0.0};

  void add(const Vec2& from, const Vec2& to, const Winding& times) {
    constexpr double kRounding =
        16.0 * std::numeric_limits<double>::epsilon();  // of the corners, two products, their
                                                        // difference, the sum
    const double first = from.x() * to.y();
    const double second = to.x() * from.y();
    for (int layer = 0; layer < 2; ++layer) {
      if (times[layer] == 0) continue;
      sum[layer] += times[layer] * (first - second);
      rounding[layer] +=
          kRounding *
          (std::abs(times[layer]) * (std::abs(first) + std::abs(second)) + std::abs(sum[layer]));
    }
  }
};

Overlay::Overlay(std::span<const ExactRing* const> first,
                 std::span<const ExactRing* const> second) {
  std::vector<Segment> edges;
  for (const ExactRing* ring : first) add_edges(*ring, 0, edges);
  for (const ExactRing* ring : second) add_edges(*ring, 1, edges);
  const std::vector<Segment> segments = merged(edges);
  Arrangement arrangement = arrangement_of(segments);

  number_elements(arrangement.vertices_begin(), arrangement.vertices_end());
  number_elements(arrangement.halfedges_begin(), arrangement.halfedges_end());
  windings_.assign(number_elements(arrangement.faces_begin(), arrangement.faces_end()),
                   Winding{0, 0});
  points_.reserve(arrangement.number_of_vertices());
  for (auto vertex = arrangement.vertices_begin(); vertex != arrangement.vertices_end(); ++vertex)
    points_.push_back(vertex->point());
  half_edges_.reserve(arrangement.number_of_halfedges());
  for (auto edge = arrangement.halfedges_begin(); edge != arrangement.halfedges_end(); ++edge) {
    HalfEdge& made = half_edges_.emplace_back(HalfEdge{.twin = edge->twin()->data(),
                                                       .next = edge->next()->data(),
                                                       .face = edge->face()->data(),
                                                       .origin = edge->source()->data(),
                                                       .rings = 0,
                                                       .step = {0, 0}});
    const int direction = edge->direction() == CGAL::ARR_LEFT_TO_RIGHT ? 1 : -1;
    const auto& numbers = edge->curve().data();
    for (auto number = numbers.begin(); number != numbers.end(); ++number) {
      made.rings += segments[*number].rings;
      for (int layer = 0; layer < 2; ++layer)
        made.step[layer] += direction * segments[*number].step[layer];
    }
  }
  find_windings(arrangement.unbounded_face()->data());
  DoubledAreas given;
  for (const Segment& segment : segments)
    given.add(rounded(*segment.low), rounded(*segment.high), segment.step);
  check_areas(given);
}

/// The arrangement's edges enclose what the rings' edges do, each place as often as its winding
/// says.
void Overlay::check_areas(const DoubledAreas& given) const {
  std::vector<Vec2> places;
  places.reserve(points_.size());
  for (const ExactPoint& point : points_) places.push_back(rounded(point));
  DoubledAreas made;
  for (const HalfEdge& edge : half_edges_) {
    const HalfEdge& twin = half_edges_[edge.twin];
    for (int layer = 0; layer < 2; ++layer) {
      if (windings_[edge.face][layer] - windings_[twin.face][layer] == edge.step[layer]) continue;
      throw NumericalError(
          "Overlay: the windings on the two sides of an edge contradict the rings along it");
    }
    made.add(places[edge.origin], places[twin.origin], windings_[edge.face]);
  }
  for (int layer = 0; layer < 2; ++layer) {
    const double difference = made.sum[layer] - given.sum[layer];
    if (std::abs(difference) <= made.rounding[layer] + given.rounding[layer]) continue;
    throw NumericalError("Overlay: faces of " + text_of(0.5 * made.sum[layer]) +
                         " m2 come from rings of " + text_of(0.5 * given.sum[layer]) + " m2");
  }
}

void Overlay::find_windings(int unbounded_face) {
  std::vector<int> face_of;
  for (const HalfEdge& edge : half_edges_) face_of.push_back(edge.face);
  sort_by_face(face_of, static_cast<int>(windings_.size()), first_of_face_, half_edges_by_face_);

  std::vector<bool> reached(windings_.size(), false);
  std::vector<int> to_do{unbounded_face};
  reached[unbounded_face] = true;
  while (!to_do.empty()) {
    const int face = to_do.back();
    to_do.pop_back();
    for (int i = first_of_face_[face]; i < first_of_face_[face + 1]; ++i) {
      const HalfEdge& edge = half_edges_[half_edges_by_face_[i]];
      const int across = half_edges_[edge.twin].face;
      if (reached[across]) continue;
      windings_[across] = {windings_[face][0] - edge.step[0], windings_[face][1] - edge.step[1]};
      reached[across] = true;
      to_do.push_back(across);
    }
  }
}

std::vector<bool> Overlay::faces_of(const Part& part) const {
  std::vector<bool> inside(windings_.size());
  for (std::size_t face = 0; face < windings_.size(); ++face) inside[face] = part(windings_[face]);
  return inside;
}

/// Walks along the part's boundary with the part on the left, around each corner inside the same
/// wedge of the part.
std::vector<Overlay::Trace> Overlay::trace(const std::vector<bool>& inside) const {
  const auto is_inside = [&](int half_edge) { return inside[half_edges_[half_edge].face]; };
  std::vector<bool> done(half_edges_.size(), false);
  std::vector<Trace> traces;
  for (int start = 0; start < static_cast<int>(half_edges_.size()); ++start) {
    if (done[start] || !is_inside(start) || is_inside(half_edges_[start].twin)) continue;
    Trace trace{.corners = {}, .face = half_edges_[start].face};
    int edge = start;
    do {
      done[edge] = true;
      trace.corners.push_back(half_edges_[edge].origin);
      edge = half_edges_[edge].next;
      while (is_inside(half_edges_[edge].twin)) edge = half_edges_[half_edges_[edge].twin].next;
    } while (edge != start);
    traces.push_back(std::move(trace));
  }
  return traces;
}

/// For each face of the part, the number of the piece (connected across edges) that it belongs to;
/// -1 outside.
std::vector<int> Overlay::components(const std::vector<bool>& inside) const {
  std::vector<int> component(windings_.size(), -1);
  int count = 0;
  std::vector<int> to_do;
  for (int seed = 0; seed < static_cast<int>(windings_.size()); ++seed) {
    if (!inside[seed] || component[seed] >= 0) continue;
    component[seed] = count;
    to_do.push_back(seed);
    while (!to_do.empty()) {
      const int face = to_do.back();
      to_do.pop_back();
      for (int i = first_of_face_[face]; i < first_of_face_[face + 1]; ++i) {
        const int across = half_edges_[half_edges_[half_edges_by_face_[i]].twin].face;
        if (!inside[across] || component[across] >= 0) continue;
        component[across] = count;
        to_do.push_back(across);
      }
    }
    ++count;
  }
  return component;
}

std::vector<ExactPolygon> Overlay::polygons(const Part& part) const {
  const std::vector<bool> inside = faces_of(part);
  const std::vector<int> component = components(inside);
  std::vector<ExactPolygon> polygons(
      component.empty() ? 0 : 1 + *std::max_element(component.begin(), component.end()));
  std::vector<int> place_on_path(points_.size(), -1);
  for (const Trace& trace : trace(inside)) {
    ExactPolygon& polygon = polygons[component[trace.face]];
    for (const std::vector<int>& corners : split_at_repeats(trace.corners, place_on_path)) {
      ExactRing ring = normal_form(corners, points_);
      if (!runs_counter_clockwise(ring)) {
        polygon.holes.push_back(std::move(ring));
      } else if (polygon.outer.empty()) {
        polygon.outer = std::move(ring);
      } else {
        throw NumericalError("Overlay: a piece of a region has two outer rings");
      }
    }
  }
  return polygons;
}

double Overlay::area(const Part& part) const {
  std::vector<ExactRing> rings;
  for (const Trace& trace : trace(faces_of(part))) {
    ExactRing& ring = rings.emplace_back();
    for (const int corner : trace.corners) ring.push_back(points_[corner]);
  }
  return signed_area(rings);
}

bool Overlay::any(const Part& part) const {
  return std::any_of(windings_.begin(), windings_.end(), part);
}

std::optional<std::array<ExactPoint, 2>> Overlay::overlap() const {
  const HalfEdge* lowest = nullptr;
  for (const HalfEdge& edge : half_edges_) {
    if (edge.rings > 1 &&
        (lowest == nullptr || is_lower(points_[edge.origin], points_[lowest->origin])))
      lowest = &edge;
  }
  if (lowest == nullptr) return std::nullopt;
  return std::array{points_[lowest->origin], points_[half_edges_[lowest->twin].origin]};
}

std::optional<ExactPoint> Overlay::crossing() const {
  constexpr int kMost = std::numeric_limits<int>::max();
  std::vector<std::pair<int, int>> range(points_.size(), {kMost, -kMost});
  for (const HalfEdge& edge : half_edges_) {
    auto& [least, greatest] = range[edge.origin];
    least = std::min(least, windings_[edge.face][0]);
    greatest = std::max(greatest, windings_[edge.face][0]);
  }
  std::optional<ExactPoint> lowest;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (range[i].second > range[i].first + 1) take_lower(points_[i], lowest);
  }
  return lowest;
}

std::optional<ExactPoint> Overlay::lowest(const Part& part) const {
  const std::vector<bool> inside = faces_of(part);
  std::optional<ExactPoint> lowest;
  for (const HalfEdge& edge : half_edges_) {
    if (inside[edge.face]) take_lower(points_[edge.origin], lowest);
  }
  return lowest;
}

}  // namespace palpation
