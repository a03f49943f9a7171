#include "draw/unroll.h"

#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <Eigen/Geometry>
#include <cmath>

#include "draw/place.h"

namespace palpation::draw {
namespace {

constexpr double kMuchHidden = 0.05;  // of the area: less is a rim that turns away

bool is_folded(vtkPolyData& surface) {
  std::vector<Vec3> areas;
  Vec3 sum = Vec3::Zero();
  for (vtkIdType triangle = 0; triangle < surface.GetNumberOfPolys(); ++triangle) {
    const auto& [a, b, c] = corners_of(surface, triangle).places;
    areas.push_back((b - a).cross(c - a));
    sum += areas.back();
  }
  double hidden = 0.0, all = 0.0;
  for (const Vec3& area : areas) {
    all += area.norm();
    if (area.dot(sum) < 0.0) hidden += area.norm();
  }
  return hidden > kMuchHidden * all;
}

}  // namespace

Outcome unrolled_where_folded(Outcome outcome) {
  vtkDataArray* u = outcome.field("chart_u");
  vtkDataArray* v = outcome.field("chart_v");
  if (u == nullptr || v == nullptr || !is_folded(*outcome.surface)) return outcome;
  const TriangleTree tree(*outcome.surface);
  const auto moved = [&](const Vec3& place) {
    return Vec3(tree.value_at(*u, place), tree.value_at(*v, place), 0.0);
  };
  for (Curve& curve : outcome.curves) {
    for (Vec3& point : curve.points) point = moved(point);
    std::erase_if(curve.points, [](const Vec3& point) { return !point.allFinite(); });
  }
  std::erase_if(outcome.curves, [](const Curve& curve) { return curve.points.empty(); });
  for (Touch& touch : outcome.touches) touch.position = moved(touch.position);
  std::erase_if(outcome.touches, [](const Touch& touch) { return !touch.position.allFinite(); });
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < outcome.surface->GetNumberOfPoints(); ++i) {
    points->InsertNextPoint(u->GetComponent(i, 0), v->GetComponent(i, 0), 0.0);
  }
  outcome.surface->SetPoints(points);
  outcome.unrolled = true;
  return outcome;
}

}  // namespace palpation::draw
