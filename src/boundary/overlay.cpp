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

}  // namespace palpation
