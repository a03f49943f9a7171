#include "draw/place.h"

#include <vtkCellArray.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace palpation::draw {
namespace {

bool box_contains(const Corners& corners, const Vec3& place) {
  const Vec3 lowest = corners.places[0].cwiseMin(corners.places[1]).cwiseMin(corners.places[2]);
  const Vec3 highest = corners.places[0].cwiseMax(corners.places[1]).cwiseMax(corners.places[2]);
  const double slack = 1e-6 * (highest - lowest).norm();
  return (place.array() >= lowest.array() - slack).all() && (place.array() <= highest.array() + slack).all();
}

// Areas of the triangles that a place makes with the sides opposite to the corners: barycentric weights once divided by their sum.
Vec3 opposite_areas(const Corners& corners, const Vec3& place) {
  const auto& [a, b, c] = corners.places;
  return {(b - place).cross(c - place).norm(), (c - place).cross(a - place).norm(), (a - place).cross(b - place).norm()};
}

}  // namespace

Corners corners_of(vtkPolyData& surface, vtkIdType triangle) {
  Corners corners;
  vtkIdType size = 0;
  const vtkIdType* vertices = nullptr;
  surface.GetPolys()->GetCellAtId(triangle, size, vertices);
  for (std::size_t i = 0; i < 3; ++i) {
    corners.vertices[i] = vertices[i];
    surface.GetPoint(vertices[i], corners.places[i].data());
  }
  return corners;
}

double value_at(vtkPolyData& surface, vtkDataArray& field, const Vec3& place) {
  double least_excess = std::numeric_limits<double>::infinity();
  double value = std::nan("");
  for (vtkIdType triangle = 0; triangle < surface.GetNumberOfPolys(); ++triangle) {
    const Corners corners = corners_of(surface, triangle);
    if (!box_contains(corners, place)) continue;
    const Vec3 areas = opposite_areas(corners, place);
    const double excess = areas.sum() - opposite_areas(corners, corners.places[0]).sum();
    if (excess >= least_excess || areas.sum() == 0.0) continue;
    least_excess = excess;
    const auto at = [&](std::size_t i) { return field.GetComponent(corners.vertices[i], 0); };
    value = areas.dot(Vec3(at(0), at(1), at(2))) / areas.sum();
  }
  return value;
}

}  // namespace palpation::draw
