/// A metric mesh that grows, triangle by triangle.
#pragma once

#include <vector>

#include "geometry/laplacian.h"

namespace palpation {

class MetricBuilder {
 public:
  /// Starts from a mesh, whose edges are never split.
  explicit MetricBuilder(const MetricMesh& mesh);

  int add_vertex() { return vertex_count_++; }
  /// Lengths as MetricMesh has them; edges much longer than `target` are to be split in the end.
  int add_face(const Eigen::Vector3i& vertices, const Vec3& lengths, double target);
  void glue(int half_edge, int other);
  double length(int half_edge) const { return faces_[half_edge / 3].lengths[half_edge % 3]; }
  double angle(int face, int corner) const;

  /// Flips edges between added faces of one target, until they are Delaunay: what fills a notch is
  /// long and thin before, and would be split into far more triangles than its area asks for.
  void flip_to_delaunay();

  /// Halves the longest edges of added triangles while they are longer than 1.8 times their target.
  void split_long_edges();
  MetricMesh done() const;

 private:
  struct Face {
    Eigen::Vector3i vertices;
    Vec3 lengths;
    Eigen::Vector3i across;
    double target;
  };

  void split(int half_edge);
  int halve(int half_edge, int middle);

  int vertex_count_;
  int fixed_;  // faces of the mesh
  std::vector<Face> faces_;
};

}  // namespace palpation
