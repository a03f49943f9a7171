#include "boundary/superlevel_parts.h"

#include <numeric>

namespace palpation {

std::vector<std::vector<int>> superlevel_parts(const Surface& surface, const Field& field,
                                               double level) {
  std::vector<int> root(static_cast<std::size_t>(surface.vertex_count()));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int vertex) {
    while (root[vertex] != vertex) vertex = root[vertex] = root[root[vertex]];
    return vertex;
  };
  for (Eigen::Index face = 0; face < surface.mesh().triangles.rows(); ++face) {
    for (int side = 0; side < 3; ++side) {
      const int a = surface.mesh().triangles(face, side),
                b = surface.mesh().triangles(face, (side + 1) % 3);
      if (field[a] >= level && field[b] >= level) root[find(a)] = find(b);
    }
  }
  std::vector<int> number(root.size(), -1);
  std::vector<std::vector<int>> parts;
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    if (field[vertex] < level) continue;
    int& part = number[find(vertex)];
    if (part < 0) {
      part = static_cast<int>(parts.size());
      parts.emplace_back();
    }
    parts[part].push_back(vertex);
  }
  return parts;
}

}  // namespace palpation
