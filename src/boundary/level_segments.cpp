#include "boundary/level_segments.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkContourFilter.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkNonMergingPointLocator.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "palpation/base/error.h"

namespace palpation {

namespace {

/// A triangle that the level crosses. The apex is the corner that is alone on its side.
struct CrossedFace {
  int face;
  int apex;
  bool apex_inside;
};

std::vector<CrossedFace> crossed_faces(const Surface& surface, const Field& field, double level) {
  std::vector<CrossedFace> crossed;
  const Triangles& triangles = surface.mesh().triangles;
  for (int face = 0; face < surface.face_count(); ++face) {
    const std::array<bool, 3> inside{field[triangles(face, 0)] >= level, field[triangles(face, 1)] >= level,
                                     field[triangles(face, 2)] >= level};
    if (inside[0] == inside[1] && inside[1] == inside[2]) continue;
    const int apex = inside[1] == inside[2] ? 0 : (inside[0] == inside[2] ? 1 : 2);
    crossed.push_back({face, apex, inside[apex]});
  }
  return crossed;
}

/// The crossed triangles by themselves, each with corners of its own, which carry their barycentric weights: so each point that the filter
/// makes tells where it is in its triangle, exactly, and no point is looked up or merged by its coordinates.
vtkNew<vtkPolyData> corners_of(const std::vector<CrossedFace>& crossed, const Surface& surface, const Field& field, double scale) {
  const auto count = static_cast<vtkIdType>(crossed.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(3 * count);
  vtkNew<vtkDoubleArray> values;
  values->SetName("field");
  values->SetNumberOfTuples(3 * count);
  vtkNew<vtkDoubleArray> weights;
  weights->SetName("weights");
  weights->SetNumberOfComponents(3);
  weights->SetNumberOfTuples(3 * count);
  vtkNew<vtkIntArray> numbers;
  numbers->SetName("number");
  numbers->SetNumberOfTuples(count);
  vtkNew<vtkCellArray> cells;
  cells->AllocateExact(count, 3 * count);
  for (vtkIdType i = 0; i < count; ++i) {
    const Eigen::Vector3i triangle = surface.triangle(crossed[i].face);
    for (int corner = 0; corner < 3; ++corner) {
      points->SetPoint(3 * i + corner, surface.vertex(triangle[corner]).data());
      values->SetValue(3 * i + corner, scale * field[triangle[corner]]);
      weights->SetTuple(3 * i + corner, Vec3(Vec3::Unit(corner)).data());
    }
    numbers->SetValue(i, static_cast<int>(i));
    cells->InsertNextCell({3 * i, 3 * i + 1, 3 * i + 2});
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetPolys(cells);
  mesh->GetPointData()->SetScalars(values);
  mesh->GetPointData()->AddArray(weights);
  mesh->GetCellData()->AddArray(numbers);
  return mesh;
}

/// Weights of the two ends of the line in each crossed triangle, in the filter's order.
std::vector<std::array<Vec3, 2>> contour(const std::vector<CrossedFace>& crossed, vtkPolyData* mesh, double level) {
  vtkNew<vtkNonMergingPointLocator> locator;
  vtkNew<vtkContourFilter> filter;
  filter->SetInputData(mesh);
  filter->SetLocator(locator);
  filter->SetValue(0, level);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->ComputeNormalsOff();
  filter->Update();
  vtkPolyData* lines = filter->GetOutput();
  vtkDataArray* weights = lines->GetPointData()->GetArray("weights");
  auto* numbers = vtkIntArray::SafeDownCast(lines->GetCellData()->GetArray("number"));
  const auto count = static_cast<vtkIdType>(crossed.size());
  if (lines->GetNumberOfLines() != count || lines->GetNumberOfCells() != count || weights == nullptr || numbers == nullptr) {
    throw NumericalError("level_loops: the contour filter made " + std::to_string(lines->GetNumberOfLines()) + " lines in " +
                         std::to_string(count) + " triangles that the level " + text_of(level) + " crosses");
  }
  std::vector<std::array<Vec3, 2>> ends(crossed.size());
  vtkCellArray* cells = lines->GetLines();
  for (vtkIdType i = 0; i < count; ++i) {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    cells->GetCellAtId(i, size, ids);
    for (int end = 0; end < 2; ++end) weights->GetTuple(ids[end], ends[numbers->GetValue(i)][end].data());
  }
  return ends;
}

/// Tells the two ends apart: an end with weight at the far corner of one of the apex' two edges is on that edge; without, it is at the apex
/// itself, which is on both.
LevelSegment segment(const CrossedFace& crossed, std::array<Vec3, 2> ends) {
  const int next = (crossed.apex + 1) % 3;
  const int previous = (crossed.apex + 2) % 3;
  if (ends[0][previous] > 0.0 || ends[1][next] > 0.0) std::swap(ends[0], ends[1]);
  if (ends[0][previous] != 0.0 || ends[1][next] != 0.0) {
    throw NumericalError("level_loops: the contour filter left the edges of triangle " + std::to_string(crossed.face));
  }
  LevelSegment made{.face = crossed.face, .entry = crossed.apex, .exit = previous, .entry_weights = ends[0], .exit_weights = ends[1]};
  if (!crossed.apex_inside) {
    std::swap(made.entry, made.exit);
    std::swap(made.entry_weights, made.exit_weights);
  }
  return made;
}

}  // namespace

double safe_scale(const Field& field, double level) {
  const double greatest = std::max(std::abs(level), field.size() > 0 ? field.cwiseAbs().maxCoeff() : 0.0);
  return greatest > 1e300 ? 0x1p-8 : 1.0;
}

std::vector<LevelSegment> level_segments(const Surface& surface, const Field& field, double level) {
  const std::vector<CrossedFace> crossed = crossed_faces(surface, field, level);
  if (crossed.empty()) return {};
  const double scale = safe_scale(field, level);
  const auto mesh = corners_of(crossed, surface, field, scale);
  const auto ends = contour(crossed, mesh, scale * level);
  std::vector<LevelSegment> segments;
  segments.reserve(crossed.size());
  for (std::size_t i = 0; i < crossed.size(); ++i) segments.push_back(segment(crossed[i], ends[i]));
  return segments;
}

}  // namespace palpation
