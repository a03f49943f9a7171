#include "geometry/cut_out.h"

#include <algorithm>
#include <numeric>

namespace palpation {
namespace {

std::vector<bool> component_of(const Surface& surface, const std::vector<bool>& keep, int seed) {
  std::vector<bool> inside(keep.size(), false);
  std::vector<int> waiting{seed};
  inside[seed] = true;
  while (!waiting.empty()) {
    const int face = waiting.back();
    waiting.pop_back();
    for (int i = 0; i < 3; ++i) {
      const int next = surface.neighbour(face, i);
      if (next < 0 || !keep[next] || inside[next]) continue;
      inside[next] = true;
      waiting.push_back(next);
    }
  }
  return inside;
}

int corner_of(const Surface& surface, int face, int vertex) {
  const Eigen::Vector3i corners = surface.triangle(face);
  return corners[0] == vertex ? 0 : (corners[1] == vertex ? 1 : 2);
}

/// Gives every corner of the part a number: one for each fan around each vertex.
class Fans {
 public:
  Fans(const Surface& surface, const std::vector<bool>& inside)
      : surface_(surface),
        inside_(inside),
        fan_of_corner_(Triangles::Constant(surface.face_count(), 3, -1)) {
    for (int f = 0; f < surface.face_count(); ++f) {
      for (int i = 0; inside[f] && i < 3; ++i) {
        if (fan_of_corner_(f, i) >= 0) continue;
        vertex_of_fan_.push_back(surface.triangle(f)[i]);
        spread(f, i, 2);
        spread(f, i, 0);
      }
    }
    number_by_vertex();
  }

  int operator()(int face, int corner) const { return fan_of_corner_(face, corner); }
  const std::vector<int>& vertices() const { return vertex_of_fan_; }

 private:
  /// Walks around the corner's vertex, over the edge that comes in (offset 2) or goes out (offset
  /// 0), as far as the part reaches.
  void spread(int face, int corner, int edge_offset) {
    const int fan = static_cast<int>(vertex_of_fan_.size()) - 1;
    const int start = face;
    do {
      fan_of_corner_(face, corner) = fan;
      face = surface_.neighbour(face, (corner + edge_offset) % 3);
      if (face >= 0) corner = corner_of(surface_, face, vertex_of_fan_[fan]);
    } while (face >= 0 && inside_[face] && face != start);
  }

  void number_by_vertex() {
    std::vector<int> order(vertex_of_fan_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [this](int a, int b) { return vertex_of_fan_[a] < vertex_of_fan_[b]; });
    std::vector<int> new_number(order.size()), vertices(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      new_number[order[k]] = static_cast<int>(k);
      vertices[k] = vertex_of_fan_[order[k]];
    }
    for (int& fan : fan_of_corner_.reshaped()) fan = fan < 0 ? -1 : new_number[fan];
    vertex_of_fan_ = std::move(vertices);
  }

  const Surface& surface_;
  const std::vector<bool>& inside_;
  Triangles fan_of_corner_;
  std::vector<int> vertex_of_fan_;
};

}  // namespace

CutOut cut_out(const Surface& surface, const std::vector<bool>& keep, int seed) {
  const std::vector<bool> inside = component_of(surface, keep, seed);
  const Fans fans(surface, inside);
  CutOut part;
  part.vertices = fans.vertices();
  for (int f = 0; f < surface.face_count(); ++f) {
    if (inside[f]) part.faces.push_back(f);
  }
  part.mesh.vertices.resize(static_cast<Eigen::Index>(part.vertices.size()), 3);
  for (std::size_t v = 0; v < part.vertices.size(); ++v)
    part.mesh.vertices.row(v) = surface.vertex(part.vertices[v]);
  part.mesh.triangles.resize(static_cast<Eigen::Index>(part.faces.size()), 3);
  for (std::size_t f = 0; f < part.faces.size(); ++f) {
    for (int i = 0; i < 3; ++i)
      part.mesh.triangles(static_cast<Eigen::Index>(f), i) = fans(part.faces[f], i);
  }
  return part;
}

}  // namespace palpation
