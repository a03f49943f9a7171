/// The edges of a triangle list, found by sorting: the way to see what the edges are before any
/// mesh structure trusts them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "palpation/geometry/triangle_mesh.h"

namespace palpation {

/// Half-edge 3 f + i runs from corner i to corner i+1 (mod 3) of triangle f.
inline int half_edge_start(const Triangles& triangles, int half_edge) {
  return triangles(half_edge / 3, half_edge % 3);
}
inline int half_edge_end(const Triangles& triangles, int half_edge) {
  return triangles(half_edge / 3, (half_edge % 3 + 1) % 3);
}

/// Edges by increasing lower end, then higher end, each with its half-edges in increasing order.
class EdgeTable {
 public:
  /// Every index must be between 0 and vertex_count - 1.
  EdgeTable(const Triangles& triangles, int vertex_count);

  int size() const { return static_cast<int>(first_.size()) - 1; }
  std::span<const int> half_edges(int edge) const {
    return std::span(half_edges_).subspan(first_[edge], first_[edge + 1] - first_[edge]);
  }

 private:
  std::vector<int> half_edges_;
  std::vector<int> first_;
};

}  // namespace palpation
