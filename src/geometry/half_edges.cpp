#include "geometry/half_edges.h"

#include <algorithm>
#include <utility>

namespace palpation {
namespace {

/// The half-edges whose lower end is vertex v are [first[v], first[v + 1]) in the order of a
/// counting sort.
std::vector<int> count_lower_ends(const Triangles& triangles, int vertex_count) {
  std::vector<int> first(vertex_count + 1, 0);
  const int half_edge_count = static_cast<int>(3 * triangles.rows());
  for (int h = 0; h < half_edge_count; ++h)
    ++first[std::min(half_edge_start(triangles, h), half_edge_end(triangles, h)) + 1];
  for (int v = 0; v < vertex_count; ++v) first[v + 1] += first[v];
  return first;
}

}  // namespace

EdgeTable::EdgeTable(const Triangles& triangles, int vertex_count) {
  const int half_edge_count = static_cast<int>(3 * triangles.rows());
  const std::vector<int> first_of_vertex = count_lower_ends(triangles, vertex_count);
  std::vector<int> free_place(first_of_vertex.begin(), first_of_vertex.end() - 1);
  std::vector<std::pair<int, int>> sorted(half_edge_count);  // higher end, half-edge
  for (int h = 0; h < half_edge_count; ++h) {
    const auto [low, high] =
        std::minmax({half_edge_start(triangles, h), half_edge_end(triangles, h)});
    sorted[free_place[low]++] = {high, h};
  }
  half_edges_.reserve(half_edge_count);
  for (int v = 0; v < vertex_count; ++v) {
    std::sort(sorted.begin() + first_of_vertex[v], sorted.begin() + first_of_vertex[v + 1]);
    for (int place = first_of_vertex[v]; place < first_of_vertex[v + 1]; ++place) {
      const bool is_new_edge =
          place == first_of_vertex[v] || sorted[place].first != sorted[place - 1].first;
      if (is_new_edge) first_.push_back(place);
      half_edges_.push_back(sorted[place].second);
    }
  }
  first_.push_back(half_edge_count);
}

}  // namespace palpation
