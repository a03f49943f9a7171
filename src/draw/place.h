/// Places on a triangulated surface.
#pragma once

#include <vtkDataArray.h>
#include <vtkPolyData.h>

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "palpation/base/types.h"

namespace palpation::draw {

struct Corners {
  std::array<vtkIdType, 3> vertices{};
  std::array<Vec3, 3> places;
};

Corners corners_of(vtkPolyData& surface, vtkIdType triangle);

/// Finds the triangle that holds a place of a surface, which must stay as it is meanwhile. A tree
/// of boxes over its triangles: memory is that of two boxes a triangle, however flat the surface
/// (VTK's static cell locator takes gigabytes there).
class TriangleTree {
 public:
  explicit TriangleTree(vtkPolyData& surface);

  /// The field, linear in the triangle that holds the place, the first of those that hold it alike;
  /// NaN off the surface.
  double value_at(vtkDataArray& field, const Vec3& place) const;

 private:
  using Box = Eigen::AlignedBox3d;
  struct Leaf {
    vtkIdType triangle;
    Box box;
  };
  void build(std::size_t node, std::size_t first, std::size_t last);
  template <typename Visit>
  void visit(const Vec3& place, const Visit& each, std::size_t node, std::size_t first,
             std::size_t last) const;

  vtkPolyData& surface_;
  std::vector<Leaf> leaves_;
  std::vector<Box> boxes_;  // of node i those of nodes 2 i + 1 and 2 i + 2, which halve its leaves
};

}  // namespace palpation::draw
