#include "boundary/level_walk.h"

#include <algorithm>

#include "boundary/level_segments.h"

namespace palpation {

namespace {

/// The edge from a corner of a face to the next corner.
struct FaceEdge {
  int face;
  int corner;
};

int corner_of(const Surface& surface, int face, int vertex) {
  const Eigen::Vector3i triangle = surface.triangle(face);
  return triangle[0] == vertex ? 0 : (triangle[1] == vertex ? 1 : 2);
}

int origin(const Surface& surface, const FaceEdge& edge) {
  return surface.triangle(edge.face)[edge.corner];
}
int tip(const Surface& surface, const FaceEdge& edge) {
  return surface.triangle(edge.face)[(edge.corner + 1) % 3];
}

/// The border edge that leaves a border vertex with the tissue on its left: at the end of the
/// vertex' fan, which is walked from any of its faces.
FaceEdge border_edge_from(const Surface& surface, int vertex, int face) {
  for (;;) {
    const int corner = corner_of(surface, face, vertex);
    const int across = surface.neighbour(face, corner);
    if (across < 0) return {face, corner};
    face = across;
  }
}

Step step_at(const Surface& surface, int face, int entry, const Vec3& weights) {
  const Eigen::Vector3i triangle = surface.triangle(face);
  const int first = entry;
  const int second = (entry + 1) % 3;
  int low = std::min(triangle[first], triangle[second]);
  int high = std::max(triangle[first], triangle[second]);
  if (weights[first] == 0.0) low = high = triangle[second];
  if (weights[second] == 0.0) low = high = triangle[first];
  return {.point = {face, weights}, .place = {low, high}, .on_border = false};
}

Step border_step(const Surface& surface, const FaceEdge& edge) {
  const int vertex = origin(surface, edge);
  return {
      .point = {edge.face, Vec3::Unit(edge.corner)}, .place = {vertex, vertex}, .on_border = true};
}

/// Joins segments by the mesh edges they share.
class Walk {
 public:
  Walk(const Surface& surface, const Field& field, double level)
      : surface_(surface),
        field_(field),
        level_(level),
        segments_(level_segments(surface, field, level)),
        done_(segments_.size(), false) {}

  std::vector<ClosedWalk> all() {
    std::vector<ClosedWalk> walks;
    for (std::size_t start = 0; start < segments_.size(); ++start) {
      if (!done_[start]) walks.push_back(from(start));
    }
    for (const std::vector<int>& border : surface_.border_loops()) {
      if (std::all_of(border.begin(), border.end(), [&](int vertex) { return inside(vertex); }))
        walks.push_back(whole(border));
    }
    return walks;
  }

 private:
  bool inside(int vertex) const { return field_[vertex] >= level_; }

  std::size_t segment_in(int face) const {
    const auto found = std::lower_bound(
        segments_.begin(), segments_.end(), face,
        [](const LevelSegment& segment, int wanted) { return segment.face < wanted; });
    return static_cast<std::size_t>(found - segments_.begin());
  }

  ClosedWalk from(std::size_t start) {
    ClosedWalk steps;
    std::size_t current = start;
    do {
      done_[current] = true;
      const LevelSegment& segment = segments_[current];
      steps.push_back(step_at(surface_, segment.face, segment.entry, segment.entry_weights));
      const int across = surface_.neighbour(segment.face, segment.exit);
      current = segment_in(across >= 0 ? across : follow_border(segment, steps));
    } while (current != start);
    return steps;
  }

  /// Adds the steps along the border; the face where the level enters the tissue again.
  int follow_border(const LevelSegment& segment, ClosedWalk& steps) const {
    steps.push_back(step_at(surface_, segment.face, segment.exit, segment.exit_weights));
    steps.back().on_border = true;
    FaceEdge edge{segment.face, segment.exit};
    do {
      edge = border_edge_from(surface_, tip(surface_, edge), edge.face);
      steps.push_back(border_step(surface_, edge));
    } while (inside(tip(surface_, edge)));
    return edge.face;
  }

  ClosedWalk whole(const std::vector<int>& border) const {
    ClosedWalk steps;
    for (const int vertex : border)
      steps.push_back(border_step(
          surface_, border_edge_from(surface_, vertex, surface_.face_of_vertex(vertex))));
    return steps;
  }

  const Surface& surface_;
  const Field& field_;
  double level_;
  std::vector<LevelSegment> segments_;
  std::vector<bool> done_;
};

}  // namespace

std::vector<ClosedWalk> walks_around(const Surface& surface, const Field& field, double level) {
  return Walk(surface, field, level).all();
}

}  // namespace palpation
