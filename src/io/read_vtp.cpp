#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <cmath>
#include <stdexcept>

#include "io/polygon_soup.h"
#include "io/vtp_file.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

void append_points(const MeshSource& source, vtkPoints* points, PolygonSoup& soup) {
  if (points == nullptr) return;
  if (points->GetData()->GetNumberOfComponents() != 3) source.fail("points must have three components");
  soup.points.reserve(static_cast<std::size_t>(points->GetNumberOfPoints()));
  for (vtkIdType id = 0; id < points->GetNumberOfPoints(); ++id) {
    Vec3 point;
    points->GetPoint(id, point.data());
    for (int component = 0; component < 3; ++component) {
      if (std::isfinite(point[component])) continue;
      source.fail("vertex " + std::to_string(id) + ": " + "xyz"[component] + " = " + text_of(point[component]) + " is not finite");
    }
    soup.points.push_back(point);
  }
}

void append_polygons(const MeshSource& source, vtkCellArray* array, PolygonSoup& soup) {
  const VtpCells cells(source, array, "Polys");
  for (vtkIdType cell = 0; cell < cells.count(); ++cell) {
    soup.begin_face(0);
    for (vtkIdType i = 0; i < cells.size(cell); ++i) soup.corners.push_back(cells.corner(cell, i, soup.points.size()));
  }
}

/// Every other triangle of a strip runs the other way.
void append_strips(const MeshSource& source, vtkCellArray* array, PolygonSoup& soup) {
  const VtpCells cells(source, array, "Strips");
  for (vtkIdType cell = 0; cell < cells.count(); ++cell) {
    for (vtkIdType i = 0; i + 2 < cells.size(cell); ++i) {
      soup.begin_face(0);
      for (const vtkIdType k : {i, i + 1 + i % 2, i + 2 - i % 2}) soup.corners.push_back(cells.corner(cell, k, soup.points.size()));
    }
  }
}

PolygonSoup soup_of(const MeshSource& source, vtkPolyData& poly) {
  check_arrays(source, poly.GetPointData(), poly.GetNumberOfPoints(), "points");
  check_arrays(source, poly.GetCellData(), poly.GetNumberOfCells(), "cells");
  PolygonSoup soup;
  soup.format = "VTP";
  append_points(source, poly.GetPoints(), soup);
  append_polygons(source, poly.GetPolys(), soup);
  append_strips(source, poly.GetStrips(), soup);
  const vtkIdType others = poly.GetNumberOfVerts() + poly.GetNumberOfLines();
  if (others > 0) soup.warnings.push_back(std::to_string(others) + " cells are points or lines and were left out.");
  return soup;
}

}  // namespace

PolygonSoup read_vtp(const MeshSource& source) { return soup_of(source, *read_poly_data(source)); }

}  // namespace palpation
