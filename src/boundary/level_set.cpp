#include "palpation/boundary/level_set.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "boundary/level_segments.h"
#include "palpation/base/error.h"

namespace palpation {

namespace {

void require_field(const Surface& surface, const Field& field, double level, const std::string& function) {
  require(field.size() == surface.vertex_count(), function, "a field of " + std::to_string(field.size()) + " values",
          "must have one for each of the " + std::to_string(surface.vertex_count()) + " vertices");
  for (int vertex = 0; vertex < field.size(); ++vertex) {
    if (std::isfinite(field[vertex])) continue;
    require(false, function, "the field's value " + text_of(field[vertex]) + " at vertex " + std::to_string(vertex), "must be finite");
  }
  require(std::isfinite(level), function, "the level " + text_of(level), "must be finite");
}

/// The edge from a corner of a face to the next corner.
struct FaceEdge {
  int face;
  int corner;
};

int corner_of(const Surface& surface, int face, int vertex) {
  const Eigen::Vector3i triangle = surface.triangle(face);
  return triangle[0] == vertex ? 0 : (triangle[1] == vertex ? 1 : 2);
}

int origin(const Surface& surface, const FaceEdge& edge) { return surface.triangle(edge.face)[edge.corner]; }
int tip(const Surface& surface, const FaceEdge& edge) { return surface.triangle(edge.face)[(edge.corner + 1) % 3]; }

/// The border edge that leaves a border vertex with the tissue on its left: at the end of the vertex' fan, which is walked from any of its
/// faces.
FaceEdge border_edge_from(const Surface& surface, int vertex, int face) {
  for (;;) {
    const int corner = corner_of(surface, face, vertex);
    const int across = surface.neighbour(face, corner);
    if (across < 0) return {face, corner};
    face = across;
  }
}

/// Where a loop passes, by name and not by coordinates: inside the mesh edge between two vertices (a loop crosses an edge at one place
/// only), or at a vertex, which is then named twice.
struct Place {
  int low;
  int high;
  bool operator==(const Place&) const = default;
  bool at_vertex() const { return low == high; }
};

struct Step {
  SurfacePoint point;
  Place place;
  bool on_border;  ///< of the piece that follows
};

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
  return {.point = {edge.face, Vec3::Unit(edge.corner)}, .place = {vertex, vertex}, .on_border = true};
}

/// Whether the walk goes from a to b along a mesh edge and comes straight back.
bool is_spike(const Step& a, const Step& b, const Step& c) { return a.place == c.place && a.place.at_vertex() && b.place.at_vertex(); }

/// Without pieces of no length, and without lines that go somewhere and come back the same way (a ridge exactly at the level).
std::vector<Step> tidied(const std::vector<Step>& steps) {
  std::vector<Step> path;
  for (const Step& step : steps) {
    path.push_back(step);
    for (;;) {
      const std::size_t count = path.size();
      const bool repeats = count >= 2 && path[count - 2].place == path[count - 1].place;
      const bool returns = count >= 3 && is_spike(path[count - 3], path[count - 2], path[count - 1]);
      if (!repeats && !returns) break;
      path[count - (repeats ? 2 : 3)].on_border = path.back().on_border;
      path.resize(count - (repeats ? 1 : 2));
    }
  }
  // Where the loop was cut open.
  std::size_t first = 0;
  while (path.size() - first >= 2) {
    const std::size_t last = path.size() - 1;
    if (path[last].place == path[first].place || is_spike(path[last - 1], path[last], path[first])) {
      path.pop_back();
    } else if (is_spike(path[last], path[first], path[first + 1])) {
      ++first;
    } else {
      break;
    }
  }
  return {path.begin() + static_cast<std::ptrdiff_t>(first), path.end()};
}

/// Joins segments to loops by the mesh edges they share, and along the border from where one leaves the tissue to where the next one
/// enters.
class Walk {
 public:
  Walk(const Surface& surface, const Field& field, double level)
      : surface_(surface), field_(field), level_(level), segments_(level_segments(surface, field, level)), done_(segments_.size(), false) {}

  std::vector<std::vector<Step>> loops() {
    std::vector<std::vector<Step>> all;
    for (std::size_t start = 0; start < segments_.size(); ++start) {
      if (!done_[start]) all.push_back(loop_from(start));
    }
    for (const std::vector<int>& border : surface_.border_loops()) {
      if (std::all_of(border.begin(), border.end(), [&](int vertex) { return inside(vertex); })) all.push_back(whole(border));
    }
    return all;
  }

 private:
  bool inside(int vertex) const { return field_[vertex] >= level_; }

  std::size_t segment_in(int face) const {
    const auto found = std::lower_bound(segments_.begin(), segments_.end(), face,
                                        [](const LevelSegment& segment, int wanted) { return segment.face < wanted; });
    return static_cast<std::size_t>(found - segments_.begin());
  }

  std::vector<Step> loop_from(std::size_t start) {
    std::vector<Step> steps;
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
  int follow_border(const LevelSegment& segment, std::vector<Step>& steps) const {
    steps.push_back(step_at(surface_, segment.face, segment.exit, segment.exit_weights));
    steps.back().on_border = true;
    FaceEdge edge{segment.face, segment.exit};
    do {
      edge = border_edge_from(surface_, tip(surface_, edge), edge.face);
      steps.push_back(border_step(surface_, edge));
    } while (inside(tip(surface_, edge)));
    return edge.face;
  }

  std::vector<Step> whole(const std::vector<int>& border) const {
    std::vector<Step> steps;
    for (const int vertex : border)
      steps.push_back(border_step(surface_, border_edge_from(surface_, vertex, surface_.face_of_vertex(vertex))));
    return steps;
  }

  const Surface& surface_;
  const Field& field_;
  double level_;
  std::vector<LevelSegment> segments_;
  std::vector<bool> done_;
};

double length(const Surface& surface, const LevelLoop& loop) {
  double sum = 0.0;
  Vec3 last = surface.position(loop.points.back());
  for (const SurfacePoint& point : loop.points) {
    const Vec3 here = surface.position(point);
    sum += (here - last).norm();
    last = here;
  }
  return sum;
}

LevelLoop level_loop(const std::vector<Step>& steps) {
  LevelLoop loop;
  for (const Step& step : steps) {
    loop.points.push_back(step.point);
    loop.on_border.push_back(step.on_border);
  }
  return loop;
}

void sort_by_length(const Surface& surface, std::vector<LevelLoop>& loops) {
  std::vector<std::pair<double, int>> order;
  for (std::size_t i = 0; i < loops.size(); ++i) order.emplace_back(length(surface, loops[i]), static_cast<int>(i));
  std::sort(order.begin(), order.end(), [&](const auto& a, const auto& b) {
    if (a.first != b.first) return a.first > b.first;
    const int face_a = loops[a.second].points.front().face;
    const int face_b = loops[b.second].points.front().face;
    return face_a != face_b ? face_a < face_b : a.second < b.second;
  });
  std::vector<LevelLoop> sorted;
  for (const auto& [of_length, i] : order) sorted.push_back(std::move(loops[i]));
  loops = std::move(sorted);
}

Vec2 place_in_chart(const Surface& surface, const Chart& chart, const SurfacePoint& point) {
  const Eigen::Vector3i triangle = surface.triangle(point.face);
  Vec2 place = Vec2::Zero();
  for (int corner = 0; corner < 3; ++corner) place += point.barycentric[corner] * chart.uv.row(triangle[corner]).transpose();
  return place;
}

/// How much of a triangle is inside, by the values at its corners less the level. Seen from its apex, a corner alone on its side, each edge
/// is cut at v / (v - w), and the tip cut off has the product of the two as its share.
double share_inside(const Vec3& above) {
  const std::array<bool, 3> inside{above[0] >= 0.0, above[1] >= 0.0, above[2] >= 0.0};
  if (inside[0] == inside[1] && inside[1] == inside[2]) return inside[0] ? 1.0 : 0.0;
  const int apex = inside[1] == inside[2] ? 0 : (inside[0] == inside[2] ? 1 : 2);
  const double tip_height = above[apex];
  const double tip_share = tip_height / (tip_height - above[(apex + 1) % 3]) * (tip_height / (tip_height - above[(apex + 2) % 3]));
  return inside[apex] ? tip_share : 1.0 - tip_share;
}

}  // namespace

std::vector<LevelLoop> level_loops(const Surface& surface, const Field& field, double level) {
  require_field(surface, field, level, "level_loops");
  std::vector<LevelLoop> loops;
  for (const std::vector<Step>& steps : Walk(surface, field, level).loops()) {
    const std::vector<Step> tidy = tidied(steps);
    if (tidy.size() >= 2) loops.push_back(level_loop(tidy));
  }
  sort_by_length(surface, loops);
  return loops;
}

Region superlevel_region(const Surface& surface, const Field& field, double level) {
  const Chart& chart = surface.chart();
  std::vector<Ring> rings;
  for (const LevelLoop& loop : level_loops(surface, field, level)) {
    Ring& ring = rings.emplace_back();
    for (const SurfacePoint& point : loop.points) ring.push_back(place_in_chart(surface, chart, point));
  }
  return Region::even_odd(rings);
}

double superlevel_area(const Surface& surface, const Field& field, double level) {
  require_field(surface, field, level, "superlevel_area");
  const double scale = safe_scale(field, level);
  double sum = 0.0;
  for (int face = 0; face < surface.face_count(); ++face) {
    const Eigen::Vector3i triangle = surface.triangle(face);
    Vec3 above;
    for (int corner = 0; corner < 3; ++corner) above[corner] = scale * field[triangle[corner]] - scale * level;
    sum += share_inside(above) * surface.face_area(face);
  }
  return sum;
}

double surface_area(const Surface& surface, const Region& region) {
  require(surface.chart().isometric, "surface_area", "a chart that distorts areas", "is no measure of the tissue");
  return region.area();
}

}  // namespace palpation
