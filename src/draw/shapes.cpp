#include "draw/shapes.h"

#include <vtkContourFilter.h>

#include <cmath>

namespace palpation::draw {
namespace {

constexpr int kMostHatches = 2000;

}  // namespace

vtkSmartPointer<vtkPolyData> hatching(vtkPolyData& part, double lift, double width) {
  double range[2] = {0.0, 0.0};
  part.GetScalarRange(range);
  vtkNew<vtkContourFilter> contour;
  contour->SetInputData(&part);
  int lines = 0;
  for (double value = std::ceil(range[0]); value <= range[1] && lines < kMostHatches; ++value)
    contour->SetValue(lines++, value);
  contour->Update();
  vtkPolyData* found = contour->GetOutput();
  Shapes shapes;
  vtkIdType size = 0;
  const vtkIdType* corners = nullptr;
  Vec3 from, to;
  for (vtkIdType cell = 0; cell < found->GetNumberOfLines(); ++cell) {
    found->GetLines()->GetCellAtId(cell, size, corners);
    found->GetPoint(corners[0], from.data());
    found->GetPoint(corners[size - 1], to.data());
    shapes.strip(from + Vec3(0.0, 0.0, lift), to + Vec3(0.0, 0.0, lift), width);
  }
  return shapes.polygons();
}

}  // namespace palpation::draw
