#include "palpation/io/read_boundary.h"

#include <vtkAbstractArray.h>
#include <vtkCellData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>

#include <cmath>
#include <string>
#include <vector>

#include "io/mesh_source.h"
#include "io/vtp_file.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"

namespace palpation {
namespace {

constexpr double kFarthest_m = 0.005;

Vec2 chart_place(const MeshSource& source, const Surface& surface, const Vec3& position) {
  for (double coordinate : position) {
    if (!std::isfinite(coordinate)) source.fail("a point of the boundary is not finite");
  }
  const SurfacePoint point = surface.project(position);
  const double distance = (surface.position(point) - position).norm();
  require(distance <= kFarthest_m, source.path.string(), "a point " + text_of(distance) + " m from the tissue",
          "is no boundary on it: it may lie up to 5 mm away");
  Vec2 place = Vec2::Zero();
  for (int corner = 0; corner < 3; ++corner)
    place += point.barycentric[corner] * surface.chart().uv.row(surface.triangle(point.face)[corner]).transpose();
  return place;
}

bool is_estimate(vtkStringArray* kinds, vtkIdType line) { return kinds == nullptr || kinds->GetValue(line) == "estimate"; }

}  // namespace

Region read_boundary_vtp(const std::filesystem::path& path, const Surface& surface) {
  const std::string bytes = read_file(path);
  const MeshSource source{path, bytes};
  const vtkSmartPointer<vtkPolyData> poly = read_poly_data(source);
  check_arrays(source, poly->GetCellData(), poly->GetNumberOfCells(), "cells");
  auto* kinds = vtkStringArray::SafeDownCast(poly->GetCellData()->GetAbstractArray("kind_name"));
  const VtpCells lines(source, poly->GetLines(), "Lines");
  if (lines.count() == 0 && poly->GetNumberOfCells() > 0) source.fail("holds no lines, so it is no boundary");
  std::vector<Ring> rings;
  for (vtkIdType line = 0; line < lines.count(); ++line) {
    if (!is_estimate(kinds, poly->GetNumberOfVerts() + line)) continue;
    Ring ring;
    for (vtkIdType i = 0; i < lines.size(line); ++i) {
      Vec3 position;
      poly->GetPoint(lines.corner(line, i, static_cast<std::size_t>(poly->GetNumberOfPoints())), position.data());
      ring.push_back(chart_place(source, surface, position));
    }
    if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    rings.push_back(std::move(ring));
  }
  return Region::even_odd(rings);
}

}  // namespace palpation
