#include "draw/place.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "draw/tissue.h"

namespace palpation::draw {
namespace {

double linear(const Vec3& place) { return 3.0 * place.x() - 2.0 * place.y() + 1.0; }

// Linear in each triangle is what a linear field is: so many roundings of sums near one.
constexpr double kRounding = 1e-12;

TEST(TriangleTree, GivesALinearFieldEverywhereOnTheSurface) {
  const vtkSmartPointer<vtkPolyData> surface = rectangle(2.0, 1.0, 30);
  add_field(*surface, "linear", linear);
  const TriangleTree tree(*surface);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int trial = 0; trial < 1000; ++trial) {
    const Vec3 place(2.0 * share(random), share(random), 0.0);
    EXPECT_NEAR(tree.value_at(*surface->GetPointData()->GetArray("linear"), place), linear(place),
                kRounding);
  }
}

TEST(TriangleTree, GivesAVertexItsOwnValue) {
  const vtkSmartPointer<vtkPolyData> surface = rectangle(1.0, 1.0, 3);
  add_field(*surface, "bump", [](const Vec3& place) { return place.norm() < 0.4 ? 5.0 : 0.0; });
  const TriangleTree tree(*surface);
  vtkDataArray& bump = *surface->GetPointData()->GetArray("bump");
  for (vtkIdType vertex = 0; vertex < surface->GetNumberOfPoints(); ++vertex) {
    Vec3 place;
    surface->GetPoint(vertex, place.data());
    EXPECT_NEAR(tree.value_at(bump, place), bump.GetComponent(vertex, 0), kRounding) << vertex;
  }
}

TEST(TriangleTree, KnowsNothingOffTheSurface) {
  const vtkSmartPointer<vtkPolyData> surface = rectangle(1.0, 1.0, 3);
  add_field(*surface, "linear", linear);
  const TriangleTree tree(*surface);
  vtkDataArray& field = *surface->GetPointData()->GetArray("linear");
  EXPECT_TRUE(std::isnan(tree.value_at(field, {1.5, 0.5, 0.0})));
  EXPECT_TRUE(std::isnan(tree.value_at(field, {0.5, 0.5, 0.2})));
}

TEST(CornersOf, NamesAndPlacesTheCornersInTheirOrder) {
  const Corners corners = corners_of(*rectangle(2.0, 1.0, 1), 1);
  EXPECT_EQ(corners.vertices, (std::array<vtkIdType, 3>{0, 3, 2}));
  EXPECT_EQ(corners.places[1], Vec3(2.0, 1.0, 0.0));
}

}  // namespace
}  // namespace palpation::draw
