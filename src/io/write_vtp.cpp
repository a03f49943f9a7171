#include "palpation/io/write_vtp.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <set>

#include "io/vtk_polydata.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"

namespace palpation {
namespace {

namespace fs = std::filesystem;

vtkSmartPointer<vtkPolyData> triangles_of(const Surface& surface) {
  const vtkSmartPointer<vtkPoints> points = vtk_points(surface.vertex_count());
  for (int i = 0; i < surface.vertex_count(); ++i) points->SetPoint(i, surface.vertex(i).data());
  vtkNew<vtkCellArray> triangles;
  triangles->AllocateExact(surface.face_count(), vtkIdType{3} * surface.face_count());
  for (int face = 0; face < surface.face_count(); ++face) {
    const Eigen::Vector3i corners = surface.triangle(face);
    triangles->InsertNextCell({corners[0], corners[1], corners[2]});
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->SetPolys(triangles);
  return result;
}

void check_fields(const Surface& surface,
                  const std::vector<std::pair<std::string, Field>>& fields) {
  std::set<std::string> names;
  for (const auto& [name, field] : fields) {
    require(!name.empty() && names.insert(name).second, "write_surface_vtp", "field '" + name + "'",
            "needs a name of its own");
    require(field.size() == surface.vertex_count(), "write_surface_vtp",
            "field '" + name + "' with " + std::to_string(field.size()) + " values",
            "must have one a vertex, " + std::to_string(surface.vertex_count()));
  }
}

void check_curves(const Surface& surface, std::span<const BoundaryCurve> curves) {
  const Points& vertices = surface.mesh().vertices;
  const double slack_m = 1e-6 * surface.diameter();
  const Vec3 lowest = vertices.colwise().minCoeff().transpose().array() - slack_m;
  const Vec3 highest = vertices.colwise().maxCoeff().transpose().array() + slack_m;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const std::string curve = "curve " + std::to_string(i);
    require(curves[i].points.size() >= 2, "write_boundary_vtp", curve,
            "must have at least two points");
    const bool near =
        std::all_of(curves[i].points.begin(), curves[i].points.end(), [&](const Vec3& point) {
          return (point.array() >= lowest.array()).all() &&
                 (point.array() <= highest.array()).all();
        });
    require(near, "write_boundary_vtp", curve, "must lie on the surface");
  }
}

void add_polyline(vtkPoints& points, vtkCellArray& lines, const BoundaryCurve& curve) {
  lines.InsertNextCell(static_cast<int>(curve.points.size()) + 1);
  const vtkIdType first = points.GetNumberOfPoints();
  for (const Vec3& point : curve.points)
    lines.InsertCellPoint(points.InsertNextPoint(point.data()));
  lines.InsertCellPoint(first);
}

template <typename Value>
vtkSmartPointer<vtkIntArray> int_array(const char* name, std::span<const BoundaryCurve> curves,
                                       Value value_of) {
  auto array = vtkSmartPointer<vtkIntArray>::New();
  array->SetName(name);
  for (const BoundaryCurve& curve : curves) array->InsertNextValue(value_of(curve));
  return array;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

}  // namespace

std::string name_of(CurveKind kind) {
  switch (kind) {
    case CurveKind::Estimate:
      return "estimate";
    case CurveKind::Truth:
      return "truth";
    case CurveKind::BandInner:
      return "band_inner";
    case CurveKind::BandOuter:
      return "band_outer";
    case CurveKind::Cut:
      return "cut";
  }
  throw InvalidInput("name_of: curve kind " + std::to_string(static_cast<int>(kind)) +
                     " does not exist");
}

void write_surface_vtp(const fs::path& path, const Surface& surface,
                       const std::vector<std::pair<std::string, Field>>& fields, Frame frame) {
  check_fields(surface, fields);
  const vtkSmartPointer<vtkPolyData> polydata = triangles_of(surface);
  for (const auto& [name, field] : fields)
    polydata->GetPointData()->AddArray(array_of(name, field));
  tell_coordinates(*polydata, LengthUnit::Metre, frame);
  write_polydata(path, *polydata);
}

void write_boundary_vtp(const fs::path& path, const Surface& surface,
                        std::span<const BoundaryCurve> curves, Frame frame) {
  check_curves(surface, curves);
  const vtkSmartPointer<vtkPoints> points = vtk_points(0);
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkStringArray> names;
  names->SetName("kind_name");
  for (const BoundaryCurve& curve : curves) {
    add_polyline(*points, *lines, curve);
    names->InsertNextValue(name_of(curve.kind).c_str());
  }
  vtkNew<vtkPolyData> polydata;
  polydata->SetPoints(points);
  polydata->SetLines(lines);
  vtkCellData* cells = polydata->GetCellData();
  cells->AddArray(int_array(
      "kind", curves, [](const BoundaryCurve& curve) { return static_cast<int>(curve.kind); }));
  cells->AddArray(names);
  cells->AddArray(int_array("part", curves, [](const BoundaryCurve& curve) { return curve.part; }));
  cells->AddArray(
      int_array("hole", curves, [](const BoundaryCurve& curve) { return curve.hole ? 1 : 0; }));
  tell_coordinates(*polydata, LengthUnit::Metre, frame);
  write_polydata(path, *polydata);
}

void write_pvd(const fs::path& path, const std::vector<std::string>& files) {
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (std::size_t step = 0; step < files.size(); ++step) {
    xml += "    <DataSet timestep=\"" + std::to_string(step) + "\" group=\"\" part=\"0\" file=\"" +
           escaped(files[step]) + "\"/>\n";
  }
  write_atomically(path, xml + "  </Collection>\n</VTKFile>\n");
}

}  // namespace palpation
