#include "draw/place.h"

#include <vtkCellArray.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace palpation::draw {
namespace {

constexpr std::size_t kFew = 8;  // leaves that are looked through one by one

Eigen::AlignedBox3d box_of(const Corners& corners) {
  Eigen::AlignedBox3d box;
  for (const Vec3& place : corners.places) box.extend(place);
  const Vec3 slack = Vec3::Constant(1e-6 * box.diagonal().norm());
  return {box.min() - slack, box.max() + slack};
}

// Areas of the triangles that a place makes with the sides opposite to the corners: barycentric
// weights once divided by their sum.
Vec3 opposite_areas(const Corners& corners, const Vec3& place) {
  const auto& [a, b, c] = corners.places;
  return {(b - place).cross(c - place).norm(), (c - place).cross(a - place).norm(),
          (a - place).cross(b - place).norm()};
}

}  // namespace

Corners corners_of(vtkPolyData& surface, vtkIdType triangle) {
  Corners corners;
  vtkIdType size = 0;
  const vtkIdType* vertices = nullptr;
  surface.GetPolys()->GetCellAtId(triangle, size, vertices);
  for (std::size_t i = 0; i < 3; ++i) {
    corners.vertices[i] = vertices[i];
    surface.GetPoint(vertices[i], corners.places[i].data());
  }
  return corners;
}

TriangleTree::TriangleTree(vtkPolyData& surface) : surface_(surface) {
  for (vtkIdType triangle = 0; triangle < surface.GetNumberOfPolys(); ++triangle) {
    const Corners corners = corners_of(surface, triangle);
    const bool finite = std::all_of(corners.places.begin(), corners.places.end(),
                                    [](const Vec3& place) { return place.allFinite(); });
    if (finite) leaves_.push_back({triangle, box_of(corners)});
  }
  build(0, 0, leaves_.size());
}

void TriangleTree::build(std::size_t node, std::size_t first, std::size_t last) {
  if (boxes_.size() <= node) boxes_.resize(node + 1);
  Box box;
  for (std::size_t i = first; i < last; ++i) box.extend(leaves_[i].box);
  boxes_[node] = box;
  if (last - first <= kFew) return;
  Eigen::Index axis = 0;
  box.diagonal().maxCoeff(&axis);
  const std::size_t middle = first + (last - first) / 2;
  const auto at = [&](std::size_t i) { return leaves_.begin() + static_cast<std::ptrdiff_t>(i); };
  const auto centre = [&](const Leaf& leaf) { return leaf.box.min()[axis] + leaf.box.max()[axis]; };
  std::nth_element(at(first), at(middle), at(last),
                   [&](const Leaf& a, const Leaf& b) { return centre(a) < centre(b); });
  build(2 * node + 1, first, middle);
  build(2 * node + 2, middle, last);
}

template <typename Visit>
void TriangleTree::visit(const Vec3& place, const Visit& each, std::size_t node, std::size_t first,
                         std::size_t last) const {
  if (!boxes_[node].contains(place)) return;
  if (last - first <= kFew) {
    for (std::size_t i = first; i < last; ++i) {
      if (leaves_[i].box.contains(place)) each(leaves_[i].triangle);
    }
    return;
  }
  const std::size_t middle = first + (last - first) / 2;
  visit(place, each, 2 * node + 1, first, middle);
  visit(place, each, 2 * node + 2, middle, last);
}

double TriangleTree::value_at(vtkDataArray& field, const Vec3& place) const {
  std::pair least(std::numeric_limits<double>::infinity(),
                  std::numeric_limits<vtkIdType>::max());  // excess of area, triangle
  double value = std::nan("");
  const auto look_at = [&](vtkIdType triangle) {
    const Corners corners = corners_of(surface_, triangle);
    const Vec3 areas = opposite_areas(corners, place);
    const std::pair here(areas.sum() - opposite_areas(corners, corners.places[0]).sum(), triangle);
    if (here >= least || areas.sum() == 0.0) return;
    least = here;
    const auto at = [&](std::size_t i) { return field.GetComponent(corners.vertices[i], 0); };
    value = areas.dot(Vec3(at(0), at(1), at(2))) / areas.sum();
  };
  visit(place, look_at, 0, 0, leaves_.size());
  return value;
}

}  // namespace palpation::draw
