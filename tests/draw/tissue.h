/// Small tissue for tests of pictures.
#pragma once

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <functional>
#include <string>

#include "draw/outcome.h"

namespace palpation::draw {

/// A rectangle in the plane z = 0 with its corner at the origin, in cells of two triangles each.
inline vtkSmartPointer<vtkPolyData> rectangle(double width_m, double height_m, int cells) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  for (int row = 0; row <= cells; ++row) {
    for (int column = 0; column <= cells; ++column)
      points->InsertNextPoint(width_m * column / cells, height_m * row / cells, 0.0);
  }
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const vtkIdType a = row * (cells + 1) + column, b = a + 1, c = a + cells + 1, d = c + 1;
      for (const auto& corners : {std::array{a, b, d}, std::array{a, d, c}})
        triangles->InsertNextCell(3, corners.data());
    }
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  return surface;
}

/// Gives the points of a surface a field of their place.
inline void add_field(vtkPolyData& surface, const std::string& name,
                      const std::function<double(const Vec3&)>& value) {
  vtkNew<vtkDoubleArray> field;
  field->SetName(name.c_str());
  for (vtkIdType i = 0; i < surface.GetNumberOfPoints(); ++i) {
    Vec3 place;
    surface.GetPoint(i, place.data());
    field->InsertNextValue(value(place));
  }
  surface.GetPointData()->AddArray(field);
}

/// A rectangle of tissue whose estimated boundary is a square.
inline Outcome outcome_on_rectangle(double width_m, double height_m) {
  Outcome outcome;
  outcome.surface = rectangle(width_m, height_m, 4);
  const double from = 0.25 * height_m, to = 0.75 * height_m;
  outcome.curves.push_back(
      {"estimate",
       {{from, from, 0.0}, {to, from, 0.0}, {to, to, 0.0}, {from, to, 0.0}, {from, from, 0.0}}});
  return outcome;
}

}  // namespace palpation::draw
