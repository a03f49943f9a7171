/// Places on a triangulated surface.
#pragma once

#include <vtkDataArray.h>
#include <vtkPolyData.h>

#include <array>

#include "palpation/base/types.h"

namespace palpation::draw {

struct Corners {
  std::array<vtkIdType, 3> vertices{};
  std::array<Vec3, 3> places;
};

Corners corners_of(vtkPolyData& surface, vtkIdType triangle);

/// The field, linear in the triangle that holds a place of the surface; NaN off the surface. A plain search: VTK's static cell locator
/// takes gigabytes where the surface is flat.
double value_at(vtkPolyData& surface, vtkDataArray& field, const Vec3& place);

}  // namespace palpation::draw
