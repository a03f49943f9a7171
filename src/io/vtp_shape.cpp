#include "io/vtp_shape.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include <algorithm>

#include "io/length_scale.h"
#include "io/vtk_polydata.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

void add_cell(const std::string& name, const VtpShape& model, vtkCellArray& cells,
              const int* corners, std::size_t count) {
  cells.InsertNextCell(static_cast<int>(count));
  for (std::size_t i = 0; i < count; ++i) {
    require(corners[i] >= 0 && static_cast<std::size_t>(corners[i]) < model.points.size(), "vtp_of",
            name + ": corner " + std::to_string(corners[i]), "must be one of its points");
    cells.InsertCellPoint(corners[i]);
  }
}

template <typename Values>
void check_length(const std::string& name, const std::string& array, const Values& values,
                  std::size_t wanted) {
  require(values.size() == wanted, "vtp_of",
          name + ": array " + array + " with " + std::to_string(values.size()) + " values",
          "must have " + std::to_string(wanted));
}

void add_fields(const std::string& name, vtkDataSetAttributes& attributes, std::size_t count,
                const std::vector<std::pair<std::string, std::vector<double>>>& fields,
                const std::vector<std::pair<std::string, std::vector<std::string>>>& texts) {
  for (const auto& [array, values] : fields) {
    check_length(name, array, values, count);
    attributes.AddArray(array_of(
        array, Eigen::Map<const Field>(values.data(), static_cast<Eigen::Index>(values.size()))));
  }
  for (const auto& [array, values] : texts) {
    check_length(name, array, values, count);
    vtkNew<vtkStringArray> strings;
    strings->SetName(array.c_str());
    for (const std::string& value : values) strings->InsertNextValue(value.c_str());
    attributes.AddArray(strings);
  }
}

}  // namespace

std::string vtp_of(const std::string& name, const VtpShape& model, LengthUnit unit, Frame frame) {
  const vtkSmartPointer<vtkPoints> points = vtk_points(static_cast<vtkIdType>(model.points.size()));
  vtkIdType place = 0;
  for (const Vec3& point : model.points) {
    const Vec3 scaled = point.unaryExpr([unit](double m) { return from_metres(m, unit); });
    points->SetPoint(place++, scaled.data());
  }
  vtkNew<vtkCellArray> dots, lines, triangles;
  for (const int dot : model.dots) add_cell(name, model, *dots, &dot, 1);
  for (const std::vector<int>& line : model.lines)
    add_cell(name, model, *lines, line.data(), line.size());
  for (const std::array<int, 3>& triangle : model.triangles)
    add_cell(name, model, *triangles, triangle.data(), triangle.size());
  vtkNew<vtkPolyData> polydata;
  polydata->SetPoints(points);
  if (!model.dots.empty()) polydata->SetVerts(dots);
  if (!model.lines.empty()) polydata->SetLines(lines);
  if (!model.triangles.empty()) polydata->SetPolys(triangles);
  add_fields(name, *polydata->GetPointData(), model.points.size(), model.point_fields,
             model.point_texts);
  add_fields(name, *polydata->GetCellData(),
             model.dots.size() + model.lines.size() + model.triangles.size(), model.cell_fields,
             model.cell_texts);
  if (!model.point_fields.empty())
    polydata->GetPointData()->SetActiveScalars(model.point_fields.front().first.c_str());
  tell_coordinates(*polydata, unit, frame);
  return bytes_of(name, *polydata);
}

}  // namespace palpation
