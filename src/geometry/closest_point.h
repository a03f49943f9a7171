/// The search tree of a surface: closest points in logarithmic time.
#pragma once

#include <memory>
#include <vector>

#include "palpation/geometry/surface_point.h"
#include "palpation/geometry/triangle_mesh.h"

namespace palpation {

/// Immutable; safe to ask from several threads. Keeps a reference to the mesh.
class ClosestPoint {
 public:
  /// face_of_vertex: the lowest face of every vertex.
  ClosestPoint(const TriangleMesh& mesh, const std::vector<int>& face_of_vertex, double diameter);
  ~ClosestPoint();

  /// Of faces whose distances agree to 1e-12 of the diameter, the lowest.
  SurfacePoint to(const Vec3& place) const;

 private:
  struct Tree;
  std::unique_ptr<const Tree> tree_;
};

}  // namespace palpation
