#include "palpation/geometry/surface.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <memory>
#include <thread>

#include "geometry/zoo.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kPi = std::numbers::pi;

class EveryAnimal : public testing::TestWithParam<zoo::Animal> {
 protected:
  const TriangleMesh& mesh() const { return GetParam().mesh; }
  const Surface surface_{GetParam().mesh};
};

INSTANTIATE_TEST_SUITE_P(Zoo, EveryAnimal, testing::ValuesIn(zoo::animals()),
                         [](const auto& animal) {
                           std::string name = animal.param.name;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

TEST_P(EveryAnimal, HasTheTopologyItIsKnownFor) {
  EXPECT_EQ(surface_.topology().components, GetParam().topology.components);
  EXPECT_EQ(surface_.topology().borders, GetParam().topology.borders);
  EXPECT_EQ(surface_.topology().euler, GetParam().topology.euler);
  EXPECT_EQ(surface_.topology().handles, GetParam().topology.handles);
  EXPECT_EQ(static_cast<int>(surface_.border_loops().size()), GetParam().topology.borders);
}

TEST_P(EveryAnimal, KeepsItsMeshAsGiven) {
  EXPECT_EQ(surface_.mesh().vertices, mesh().vertices);
  EXPECT_EQ(surface_.mesh().triangles, mesh().triangles);
}

TEST_P(EveryAnimal, HasNeighboursThatAgreeOnTheirEdge) {
  int border_edges = 0;
  for (int f = 0; f < surface_.face_count(); ++f) {
    for (int i = 0; i < 3; ++i) {
      const int across = surface_.neighbour(f, i);
      if (across < 0) {
        ++border_edges;
        continue;
      }
      const int start = surface_.triangle(f)[i], end = surface_.triangle(f)[(i + 1) % 3];
      int shared = -1;
      for (int j = 0; j < 3; ++j) {
        if (surface_.triangle(across)[j] == end && surface_.triangle(across)[(j + 1) % 3] == start)
          shared = j;
      }
      ASSERT_GE(shared, 0) << "faces " << f << " and " << across;
      EXPECT_EQ(surface_.neighbour(across, shared), f);
    }
  }
  std::size_t border_vertices = 0;
  for (const std::vector<int>& loop : surface_.border_loops()) border_vertices += loop.size();
  EXPECT_EQ(border_edges, static_cast<int>(border_vertices));
}

TEST_P(EveryAnimal, HasBordersWithTheTissueOnTheirLeftFromTheLowestVertex) {
  int last_first = -1;
  for (const std::vector<int>& loop : surface_.border_loops()) {
    EXPECT_EQ(loop.front(), *std::min_element(loop.begin(), loop.end()));
    EXPECT_GT(loop.front(), last_first);
    last_first = loop.front();
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const int start = loop[k], end = loop[(k + 1) % loop.size()];
      bool runs_along_a_face = false;
      for (int f = 0; f < surface_.face_count(); ++f) {
        for (int i = 0; i < 3; ++i)
          runs_along_a_face |=
              surface_.triangle(f)[i] == start && surface_.triangle(f)[(i + 1) % 3] == end;
      }
      EXPECT_TRUE(runs_along_a_face) << start << " to " << end;
    }
  }
}

TEST_P(EveryAnimal, AddsUpItsAreas) {
  double faces = 0.0;
  for (int f = 0; f < surface_.face_count(); ++f) faces += surface_.face_area(f);
  EXPECT_NEAR(surface_.area(), faces, 1e-13 * faces);  // rounding of some hundred terms
  EXPECT_NEAR(surface_.vertex_areas().sum(), faces, 1e-13 * faces);
}

TEST_P(EveryAnimal, MovesWithItsMesh) {
  const Eigen::Matrix3d rotation = zoo::some_rotation();
  const Vec3 shift(3.0, -2.0, 5.0);
  const double scale = 0.01;
  const Surface other(zoo::moved(mesh(), rotation, shift, scale));
  // The shift costs two digits: coordinates of 5 with rounding 1e-15 on a body of size 1e-2,
  // relative 1e-13.
  EXPECT_NEAR(other.area(), scale * scale * surface_.area(),
              1e-11 * scale * scale * surface_.area());
  for (int v = 0; v < surface_.vertex_count(); ++v) {
    const Vec3 normal = rotation * surface_.vertex_normals().row(v).transpose();
    EXPECT_LT((other.vertex_normals().row(v).transpose() - normal).norm(), 1e-11) << "vertex " << v;
  }
  EXPECT_EQ(other.border_loops(), surface_.border_loops());
  EXPECT_EQ(other.is_planar(), surface_.is_planar());
}

TEST_P(EveryAnimal, ScalesByPowersOfTwoWithoutRounding) {
  const Surface other(zoo::moved(mesh(), Eigen::Matrix3d::Identity(), Vec3::Zero(), 0x1p-100));
  EXPECT_EQ(other.area(), surface_.area() * 0x1p-200);
  EXPECT_EQ(other.diameter(), surface_.diameter() * 0x1p-100);
  EXPECT_EQ(other.vertex_normals(), surface_.vertex_normals());
  EXPECT_EQ(other.is_planar(), surface_.is_planar());
}

TEST_P(EveryAnimal, IsTheSameUnderOtherNumbers) {
  Random random(11);
  const std::vector<int> number = zoo::shuffled(surface_.vertex_count(), random);
  const Surface other(zoo::reordered(zoo::relabelled(mesh(), number), random));
  EXPECT_NEAR(other.area(), surface_.area(), 1e-13 * surface_.area());  // another order of the sum
  EXPECT_EQ(other.topology().euler, surface_.topology().euler);
  EXPECT_EQ(other.topology().borders, surface_.topology().borders);
  for (int v = 0; v < surface_.vertex_count(); ++v) {
    EXPECT_LT((other.vertex_normals().row(number[v]) - surface_.vertex_normals().row(v)).norm(),
              1e-13);
    EXPECT_NEAR(other.vertex_areas()[number[v]], surface_.vertex_areas()[v], 1e-14);
  }
}

TEST_P(EveryAnimal, FindsEachVertexInItsLowestFace) {
  for (int v = 0; v < surface_.vertex_count(); ++v) {
    EXPECT_EQ(surface_.position(surface_.at_vertex(v)), surface_.vertex(v));
    EXPECT_EQ(surface_.at_vertex(v).face, surface_.face_of_vertex(v));
    for (int f = 0; f < surface_.face_of_vertex(v); ++f)
      EXPECT_TRUE((surface_.triangle(f).array() != v).all());
    EXPECT_EQ(surface_.nearest_vertex(surface_.vertex(v)), v);
  }
}

TEST_P(EveryAnimal, InterpolatesLinearFieldsExactly) {
  const Vec3 slope(1.0, -2.0, 0.5);
  const Field field = (mesh().vertices * slope).array() + 3.0;
  for (int f = 0; f < surface_.face_count(); f += 3) {
    const SurfacePoint point{f, Vec3(0.2, 0.3, 0.5)};
    EXPECT_NEAR(surface_.interpolate(field, point), slope.dot(surface_.position(point)) + 3.0,
                1e-13);  // rounding of numbers up to 10
  }
}

TEST(Surface, KnowsAreasOfShapesThatAreKnown) {
  EXPECT_DOUBLE_EQ(zoo::unit_square(9).area(), 1.0);
  EXPECT_DOUBLE_EQ(Surface(zoo::tetrahedron_mesh()).area(), 1.5 + std::sqrt(3.0) / 2.0);
  // A cylinder of 12 flat strips: 12 chords of length 2 sin(pi / 12), 2 high.
  EXPECT_NEAR(Surface(zoo::cylinder_mesh(1.0, 2.0, 12, 5)).area(),
              12.0 * 2.0 * std::sin(kPi / 12.0) * 2.0, 1e-13);
}

TEST(Surface, ConvergesToTheAreaOfASphereWithTheSquareOfTheEdge) {
  const double coarse = 4.0 * kPi - Surface(zoo::icosphere_mesh(3)).area();
  const double fine = 4.0 * kPi - Surface(zoo::icosphere_mesh(4)).area();
  EXPECT_NEAR(coarse / fine, 4.0, 0.05);  // the next term is of fourth order
}

TEST(Surface, HasNormalsThatPointOutwardsOnASphere) {
  const Surface sphere(zoo::icosphere_mesh(3));
  for (int v = 0; v < sphere.vertex_count(); ++v) {
    EXPECT_GT(sphere.vertex_normals().row(v).dot(sphere.vertex(v).transpose()), 1.0 - 1e-4)
        << "triangles of 0.14 rad are not quite regular";
  }
  EXPECT_NEAR(sphere.face_normal(5).norm(), 1.0, 1e-15);
}

TEST(Surface, WeighsNormalsByAngleSoThatTheTriangulationOfAFlatSideDoesNotMatter) {
  // A corner of a cube, one of whose three sides is cut in two triangles there.
  TriangleMesh corner{Points(5, 3), Triangles(4, 3)};
  corner.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0;
  corner.triangles << 0, 1, 4, 0, 4, 2, 0, 2, 3, 0, 3, 1;
  const Vec3 diagonal = Vec3(1.0, 1.0, 1.0) / std::sqrt(3.0);
  EXPECT_LT((Surface(corner).vertex_normals().row(0).transpose() - diagonal).norm(), 1e-15);
}

TEST(Surface, InterpolatesNormalsToUnitLength) {
  const Surface sphere(zoo::icosphere_mesh(1));
  const SurfacePoint middle{3, Vec3::Constant(1.0 / 3.0)};
  EXPECT_NEAR(sphere.normal(middle).norm(), 1.0, 1e-15);
  EXPECT_GT(sphere.normal(middle).dot(sphere.position(middle).normalized()), 0.999);
}

TEST(Surface, IsPlanarWhereverThePlaneIs) {
  EXPECT_TRUE(Surface(zoo::annulus_mesh(0.5, 1.0, 20, 3)).is_planar());
  EXPECT_TRUE(Surface(zoo::moved(zoo::jittered_square_mesh(8, 2), zoo::some_rotation(),
                                 Vec3(1.0, 2.0, 3.0)))
                  .is_planar());
  EXPECT_FALSE(Surface(zoo::cylinder_mesh(1.0, 2.0, 12, 5)).is_planar());
  EXPECT_FALSE(Surface(zoo::tetrahedron_mesh()).is_planar());
}

TEST(Surface, IsNotPlanarOnceAVertexStandsOutByMoreThanAMillionth) {
  TriangleMesh mesh = zoo::unit_square_mesh(4);
  mesh.vertices(12, 2) = 1e-6;
  EXPECT_TRUE(Surface(mesh).is_planar());  // the diameter is 1.4
  mesh.vertices(12, 2) = 2e-6;
  EXPECT_FALSE(Surface(mesh).is_planar());
}

TEST(Surface, IsNotPlanarWhereAFlatSheetIsFoldedBack) {
  TriangleMesh mesh = zoo::unit_square_mesh(4);
  mesh.vertices.row(12) << 3.0, 0.5, 0.0;  // the middle vertex drawn out over the border
  EXPECT_FALSE(Surface(mesh).is_planar());
}

TEST(Surface, ChoosesTheLowestOfEquallyNearVertices) {
  const Surface square = zoo::unit_square(1);
  EXPECT_EQ(square.nearest_vertex(Vec3(0.5, 0.5, 0.0)), 0);
  EXPECT_EQ(square.nearest_vertex(Vec3(0.5, 2.0, 0.0)), 2);
}

TEST(Surface, InterpolatesPastInfinitiesThatHaveNoWeight) {
  const Surface square = zoo::unit_square(1);
  Field field = Field::Zero(4);
  field[0] = std::numeric_limits<double>::infinity();
  field[1] = 7.0;
  EXPECT_EQ(square.interpolate(field, square.at_vertex(1)), 7.0);
}

TEST(Surface, RefusesElementsAndPointsThatItDoesNotHave) {
  const Surface square = zoo::unit_square(1);
  EXPECT_THROW(square.vertex(4), InvalidInput);
  EXPECT_THROW(square.vertex(-1), InvalidInput);
  EXPECT_THROW(square.triangle(2), InvalidInput);
  EXPECT_THROW(square.neighbour(0, 3), InvalidInput);
  EXPECT_THROW(square.at_vertex(4), InvalidInput);
  EXPECT_THROW(square.position({2, Vec3(1.0, 0.0, 0.0)}), InvalidInput);
  EXPECT_THROW(square.position({0, Vec3(0.5, 0.0, 0.0)}), InvalidInput);
  EXPECT_THROW(square.position({0, Vec3(1.5, -0.5, 0.0)}), InvalidInput);
  EXPECT_THROW(square.position({0, Vec3::Constant(std::numeric_limits<double>::quiet_NaN())}),
               InvalidInput);
  EXPECT_THROW(square.interpolate(Field::Zero(3), square.at_vertex(0)), InvalidInput);
  EXPECT_THROW(square.nearest_vertex(Vec3(0.0, 0.0, std::numeric_limits<double>::infinity())),
               InvalidInput);
}

TEST(Surface, ComputesNothingCostlyForAPlanarScene) {
  const Surface square = zoo::unit_square(8);
  square.chart();
  square.vertex_normals();
  square.vertex_areas();
  EXPECT_TRUE(square.computed().empty());
}

TEST(Surface, SharesWhatIsComputedBetweenCopies) {
  const Surface square = zoo::unit_square(8);
  const Surface copy = square;
  copy.project(Vec3(0.3, 0.3, 1.0));
  copy.note_computed("geodesics");
  EXPECT_EQ(square.computed(), (std::vector<std::string>{"geodesics", "search tree"}));
  EXPECT_EQ(&square.chart(), &copy.chart());
}

TEST(Surface, MayBeAskedByTwoThreadsAtOnce) {
  const Surface sphere(zoo::icosphere_mesh(3));
  std::vector<SurfacePoint> found(2);
  {
    std::vector<std::jthread> threads;
    for (int k = 0; k < 2; ++k) {
      threads.emplace_back([&, k] {
        sphere.vertex_normals();
        found[k] = sphere.project(Vec3(1.0, 2.0, 3.0));
      });
    }
  }
  EXPECT_EQ(found[0].face, found[1].face);
  EXPECT_EQ(found[0].barycentric, found[1].barycentric);
}

TEST(Surface, OutlivesTheMeshAndTheSurfaceItWasMadeFrom) {
  auto first = std::make_unique<Surface>(zoo::icosphere_mesh(1));
  const Surface copy = *first;
  first.reset();
  EXPECT_EQ(copy.vertex_count(), 42);
  EXPECT_NEAR(copy.position(copy.project(Vec3(2.0, 0.0, 0.0))).y(), 0.0, 0.1);
}

}  // namespace
}  // namespace palpation
