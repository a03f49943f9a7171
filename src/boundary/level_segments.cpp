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
#include <limits>

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
    const std::array<bool, 3> inside{field[triangles(face, 0)] >= level,
                                     field[triangles(face, 1)] >= level,
                                     field[triangles(face, 2)] >= level};
    if (inside[0] == inside[1] && inside[1] == inside[2]) continue;
    const int apex = inside[1] == inside[2] ? 0 : (inside[0] == inside[2] ? 1 : 2);
    crossed.push_back({face, apex, inside[apex]});
  }
  return crossed;
}

/// The crossed triangles by themselves, each with corners of its own, which carry their barycentric
/// weights: so each point that the filter makes tells where it is in its triangle, exactly, and no
/// point is looked up or merged by its coordinates.
vtkNew<vtkPolyData> corners_of(const std::vector<CrossedFace>& crossed, const Surface& surface,
                               const Field& field, double level, double scale) {
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
      values->SetValue(3 * i + corner, scaled_value(field[triangle[corner]], level, scale));
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
std::vector<std::array<Vec3, 2>> contour(const std::vector<CrossedFace>& crossed, vtkPolyData* mesh,
                                         double level) {
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
  if (lines->GetNumberOfLines() != count || lines->GetNumberOfCells() != count ||
      weights == nullptr || numbers == nullptr) {
    throw NumericalError("level_loops: the contour filter made " +
                         std::to_string(lines->GetNumberOfLines()) + " lines in " +
                         std::to_string(count) + " triangles that the level " + text_of(level) +
                         " crosses");
  }
  std::vector<std::array<Vec3, 2>> ends(crossed.size());
  vtkCellArray* cells = lines->GetLines();
  for (vtkIdType i = 0; i < count; ++i) {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    cells->GetCellAtId(i, size, ids);
    for (int end = 0; end < 2; ++end)
      weights->GetTuple(ids[end], ends[numbers->GetValue(i)][end].data());
  }
  return ends;
}

/// A point so near to a vertex that it has the vertex' coordinates, or is nearer than any rounding
/// of its edge, is at the vertex: so no piece of a line is without length because of it, and none
/// has the size of nothing.
Vec3 settled(const Surface& surface, int face, const Vec3& weights) {
  const Vec3 place = surface.position({face, weights});
  for (int corner = 0; corner < 3; ++corner) {
    const double others = weights[(corner + 1) % 3] + weights[(corner + 2) % 3];
    if (others < 0x1p-60 ||
        (weights[corner] > 0.0 && place == surface.vertex(surface.triangle(face)[corner])))
      return Vec3::Unit(corner);
  }
  return weights;
}

/// Where the level crosses the edge from a corner of the face to the next, as the filter says it:
/// counted from the lower value.
Vec3 crossing(const Surface& surface, const Field& field, double level, int face, int corner) {
  int low = corner;
  int high = (corner + 1) % 3;
  const Eigen::Vector3i triangle = surface.triangle(face);
  if (field[triangle[low]] > field[triangle[high]]) std::swap(low, high);
  const double from = field[triangle[low]];
  const double to = field[triangle[high]];
  const double scale = safe_scale(std::max({std::abs(from), std::abs(to), std::abs(level)}));
  const double part = (scale * level - scale * from) / (scale * to - scale * from);
  return (1.0 - part) * Vec3::Unit(low) + part * Vec3::Unit(high);
}

/// Tells the two ends apart: an end with weight at the far corner of one of the apex' two edges is
/// on that edge; without, it is at the apex itself, which is on both.
LevelSegment segment(const CrossedFace& crossed, std::array<Vec3, 2> ends) {
  const int next = (crossed.apex + 1) % 3;
  const int previous = (crossed.apex + 2) % 3;
  if (ends[0][previous] > 0.0 || ends[1][next] > 0.0) std::swap(ends[0], ends[1]);
  if (ends[0][previous] != 0.0 || ends[1][next] != 0.0) {
    throw NumericalError("level_loops: the contour filter left the edges of triangle " +
                         std::to_string(crossed.face));
  }
  LevelSegment made{.face = crossed.face,
                    .entry = crossed.apex,
                    .exit = previous,
                    .entry_weights = ends[0],
                    .exit_weights = ends[1]};
  if (!crossed.apex_inside) {
    std::swap(made.entry, made.exit);
    std::swap(made.entry_weights, made.exit_weights);
  }
  return made;
}

}  // namespace

double safe_scale(double greatest) { return greatest > 1e300 ? 0x1p-8 : 1.0; }

double scaled_value(double value, double level, double scale) {
  const double scaled = scale * value;
  // Scaling may round a tiny value up to the level: it stays below.
  return value < level && scaled >= scale * level
             ? std::nextafter(scale * level, -std::numeric_limits<double>::infinity())
             : scaled;
}

std::vector<LevelSegment> level_segments(const Surface& surface, const Field& field, double level) {
  const std::vector<CrossedFace> crossed = crossed_faces(surface, field, level);
  if (crossed.empty()) return {};
  const double scale = safe_scale(std::max(std::abs(level), field.cwiseAbs().maxCoeff()));
  const auto mesh = corners_of(crossed, surface, field, level, scale);
  const auto ends = contour(crossed, mesh, scale * level);
  std::vector<LevelSegment> segments;
  segments.reserve(crossed.size());
  for (std::size_t i = 0; i < crossed.size(); ++i) segments.push_back(segment(crossed[i], ends[i]));
  for (LevelSegment& made : segments) {
    // What was scaled for the sake of huge values may have lost the digits of tiny ones.
    if (scale != 1.0) {
      made.entry_weights = crossing(surface, field, level, made.face, made.entry);
      made.exit_weights = crossing(surface, field, level, made.face, made.exit);
    }
    made.entry_weights = settled(surface, made.face, made.entry_weights);
    made.exit_weights = settled(surface, made.face, made.exit_weights);
  }
  return segments;
}

}  // namespace palpation
