// What is asked of an overlay once it is built: the parts of the plane that a predicate of windings
// says.
#include <algorithm>
#include <limits>
#include <utility>

#include "boundary/overlay.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

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

}  // namespace

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
