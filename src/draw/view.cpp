#include "draw/view.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace palpation::draw {
namespace {

constexpr double kMarginShare = 0.008;       // of the longer visible side
constexpr double kFlatnessTolerance = 1e-6;  // of the diameter
constexpr double kAlikeCosine = 0.985;       // 10 degrees

Vec3 point_of(vtkPolyData& mesh, vtkIdType point) {
  Vec3 position;
  mesh.GetPoint(point, position.data());
  return position;
}

struct Corner {
  vtkIdType a, b, c;
};

std::vector<Corner> triangles_of(vtkPolyData& mesh) {
  std::vector<Corner> triangles;
  triangles.reserve(static_cast<std::size_t>(mesh.GetNumberOfPolys()));
  vtkIdType size = 0;
  const vtkIdType* corners = nullptr;
  for (vtkIdType cell = 0; cell < mesh.GetNumberOfPolys(); ++cell) {
    mesh.GetPolys()->GetCellAtId(cell, size, corners);
    triangles.push_back({corners[0], corners[1], corners[2]});
  }
  return triangles;
}

// The area of a triangle times its outward normal.
Vec3 area_vector(vtkPolyData& mesh, const Corner& corner) {
  const Vec3 a = point_of(mesh, corner.a);
  return 0.5 * (point_of(mesh, corner.b) - a).cross(point_of(mesh, corner.c) - a);
}

struct Facing {
  Vec3 sum = Vec3::Zero();
  double total = 0.0;
  bool is_clear() const { return total > 0.0 && sum.norm() > 0.05 * total; }
};

Facing facing_of_tissue(vtkPolyData& mesh, vtkDataArray* field, double level) {
  Facing facing;
  for (const Corner& corner : triangles_of(mesh)) {
    const bool inside = field == nullptr || (field->GetComponent(corner.a, 0) >= level &&
                                             field->GetComponent(corner.b, 0) >= level &&
                                             field->GetComponent(corner.c, 0) >= level);
    if (!inside) continue;
    const Vec3 area = area_vector(mesh, corner);
    facing.sum += area;
    facing.total += area.norm();
  }
  return facing;
}

Vec3 direction_to_viewer(const Outcome& outcome, std::optional<double> level) {
  vtkDataArray* mean = outcome.field("mean");
  const Facing whole = facing_of_tissue(*outcome.surface, nullptr, 0.0);
  const bool planar = whole.total > 0.0 && whole.sum.norm() > (1.0 - 1e-9) * whole.total;
  if (!planar && mean != nullptr && level) {
    const Facing tumour = facing_of_tissue(*outcome.surface, mean, *level);
    if (tumour.is_clear()) return tumour.sum.normalized();
  }
  if (whole.is_clear()) return whole.sum.normalized();
  return Vec3::UnitZ();
}

Eigen::Matrix3d frame_facing(const Vec3& towards_viewer) {
  const Vec3 axis = std::abs(towards_viewer.x()) > kAlikeCosine ? Vec3::UnitY() : Vec3::UnitX();
  const Vec3 right = (axis - towards_viewer * towards_viewer.dot(axis)).normalized();
  Eigen::Matrix3d turn;
  turn << right.transpose(), towards_viewer.cross(right).transpose(), towards_viewer.transpose();
  return turn;
}

Vec3 vertex_nearest_to_centroid(vtkPolyData& mesh) {
  Vec3 sum = Vec3::Zero();
  double total = 0.0;
  for (const Corner& corner : triangles_of(mesh)) {
    const double area = area_vector(mesh, corner).norm();
    sum += area * (point_of(mesh, corner.a) + point_of(mesh, corner.b) + point_of(mesh, corner.c)) /
           3.0;
    total += area;
  }
  Vec3 nearest = Vec3::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (vtkIdType i = 0; i < mesh.GetNumberOfPoints(); ++i) {
    const double distance = (point_of(mesh, i) - sum / total).norm();
    if (distance >= least) continue;
    least = distance;
    nearest = point_of(mesh, i);
  }
  return nearest;
}

// Sides that belong to one triangle only. VTK's filter for this asks for more memory than there is
// on a mesh of a million vertices.
std::vector<std::array<vtkIdType, 2>> rim_of(vtkPolyData& mesh) {
  std::vector<std::array<vtkIdType, 2>> sides;
  sides.reserve(static_cast<std::size_t>(mesh.GetNumberOfPolys()) * 3);
  for (const auto& [a, b, c] : triangles_of(mesh)) {
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      sides.push_back({std::min(from, to), std::max(from, to)});
  }
  std::sort(sides.begin(), sides.end());
  std::vector<std::array<vtkIdType, 2>> rim;
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t next = i + 1;
    while (next < sides.size() && sides[next] == sides[i]) ++next;
    if (next == i + 1) rim.push_back(sides[i]);
    i = next;
  }
  return rim;
}

}  // namespace

View view_of(const Outcome& outcome, std::optional<double> level) {
  View view;
  view.in_chart = outcome.unrolled;
  const Vec3 towards_viewer = direction_to_viewer(outcome, level);
  view.turn = frame_facing(towards_viewer);
  if (towards_viewer.z() < 1.0 - 1e-12) view.origin = vertex_nearest_to_centroid(*outcome.surface);
  Vec3 lowest = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 highest = -lowest;
  for (vtkIdType i = 0; i < outcome.surface->GetNumberOfPoints(); ++i) {
    const Vec3 place = view.to_view_mm(point_of(*outcome.surface, i));
    lowest = lowest.cwiseMin(place);
    highest = highest.cwiseMax(place);
  }
  const Vec3 size = highest - lowest;
  view.flat = size.z() <= kFlatnessTolerance * size.norm();
  const double margin = kMarginShare * std::max(size.x(), size.y());
  view.left_mm = lowest.x() - margin;
  view.bottom_mm = lowest.y() - margin;
  view.width_mm = size.x() + 2.0 * margin;
  view.height_mm = size.y() + 2.0 * margin;
  view.back_mm = lowest.z();
  view.front_mm = highest.z();
  for (const auto& [from, to] : rim_of(*outcome.surface)) {
    view.rim_mm.push_back({view.to_view_mm(point_of(*outcome.surface, from)),
                           view.to_view_mm(point_of(*outcome.surface, to))});
  }
  return view;
}

View zoomed_to(const View& whole, const Outcome& outcome, const std::vector<std::string>& kinds) {
  constexpr double kRoom = 1.3, kLeastRoom_mm = 4.0;
  Vec3 lowest = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 highest = -lowest;
  for (const Curve& curve : outcome.curves) {
    if (std::find(kinds.begin(), kinds.end(), curve.kind) == kinds.end()) continue;
    for (const Vec3& point : curve.points) {
      lowest = lowest.cwiseMin(whole.to_view_mm(point));
      highest = highest.cwiseMax(whole.to_view_mm(point));
    }
  }
  if (!whole.flat || !(lowest.x() <= highest.x())) return whole;
  const auto window = [](double low, double high, double& from, double& length) {
    const double wanted = std::min(length, kRoom * (high - low) + kLeastRoom_mm);
    from = std::clamp(0.5 * (low + high - wanted), from, from + (length - wanted));
    length = wanted;
  };
  View part = whole;
  window(lowest.x(), highest.x(), part.left_mm, part.width_mm);
  window(lowest.y(), highest.y(), part.bottom_mm, part.height_mm);
  return part;
}

}  // namespace palpation::draw
