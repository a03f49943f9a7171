// Charts of tissue that is not flat.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "geometry/zoo.h"
#include "palpation/base/error.h"
#include "palpation/geometry/chart.h"
#include "palpation/geometry/surface.h"

namespace palpation {
namespace {

/// The jittered unit square bent up to a part of a sphere, so that nothing is regular.
TriangleMesh dome_mesh(int cells, double radius = 0.8) {
  TriangleMesh mesh = zoo::jittered_square_mesh(cells, 3);
  for (auto vertex : mesh.vertices.rowwise()) {
    const double x = vertex.x() - 0.5, y = vertex.y() - 0.4, angle = std::hypot(x, y) / radius;
    const double share = angle > 0.0 ? std::sin(angle) / angle : 1.0;
    vertex << share * x, share * y, radius * std::cos(angle);
  }
  return mesh;
}

/// Vertices along uneven lines of a cylinder around the y axis, unevenly: strips of flat facets.
/// Unrolled, it is `plane`.
struct Faceted {
  TriangleMesh curved, plane;
};
Faceted faceted_cylinder(int columns, int rows) {
  Random random(5);
  std::vector<double> angles, shifts;
  for (int c = 0; c <= columns; ++c) {
    angles.push_back((c + 0.4 * random.uniform()) * 2.5 / columns);
    shifts.push_back(0.3 * random.uniform() / rows);
  }
  const auto grid = [&](const auto& place) {
    return zoo::rolled_grid_mesh(columns, rows, false, false, [&](double u, double v) {
      const int c = static_cast<int>(std::lround(u * columns)),
                r = static_cast<int>(std::lround(v * rows));
      return place(c, v + (c * 7 + r * 5) % 3 * shifts[c]);
    });
  };
  std::vector<double> along = {0.0};
  for (int c = 1; c <= columns; ++c)
    along.push_back(along.back() + 2.0 * std::sin(0.5 * (angles[c] - angles[c - 1])));
  return {grid([&](int c, double y) { return Vec3(-std::cos(angles[c]), y, std::sin(angles[c])); }),
          grid([&](int c, double y) { return Vec3(along[c], y, 0.0); })};
}

double signed_area(const Points2& uv, const Eigen::Vector3i& t) {
  const Vec2 b = uv.row(t[1]) - uv.row(t[0]), c = uv.row(t[2]) - uv.row(t[0]);
  return 0.5 * (b.x() * c.y() - b.y() * c.x());
}

/// Greatest difference of the distances of vertex pairs, over the chart's size.
double difference(const Points2& a, const Points2& b) {
  double greatest = 0.0;
  for (Eigen::Index v = 1; v < a.rows(); ++v) {
    for (const Eigen::Index w : {Eigen::Index{0}, v / 2})
      greatest =
          std::max(greatest, std::abs((a.row(v) - a.row(w)).norm() - (b.row(v) - b.row(w)).norm()));
  }
  return greatest / a.cwiseAbs().maxCoeff();
}

std::string refusal(const TriangleMesh& mesh) {
  try {
    Surface(mesh).chart();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "none";
}

TEST(CurvedChart, UnrollsAFacetedCylinderExactly) {
  const Faceted faceted = faceted_cylinder(15, 9);
  const Surface curved(faceted.curved);
  const Chart& chart = curved.chart();
  EXPECT_TRUE(chart.isometric);
  EXPECT_NEAR(chart.distortion.greatest_stretch, 1.0, 1e-12);  // rounding
  EXPECT_NEAR(chart.distortion.least_stretch, 1.0, 1e-12);
  EXPECT_LT(difference(chart.uv, faceted.plane.vertices.leftCols<2>()), 1e-13);
  EXPECT_EQ(curved.computed(), std::vector<std::string>{"chart"});
  EXPECT_FALSE(curved.is_planar());
}

TEST(CurvedChart, UnfoldsTwoTrianglesThatMeetAtARightAngle) {
  TriangleMesh mesh{Points(4, 3), Triangles(2, 3)};
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.5, 0.5, 1.0;
  mesh.triangles << 0, 1, 2, 2, 1, 3;
  const Surface surface(mesh);
  EXPECT_TRUE(surface.chart().isometric);
  for (int f = 0; f < 2; ++f)
    EXPECT_NEAR(signed_area(surface.chart().uv, surface.triangle(f)), surface.face_area(f), 1e-15);
}

TEST(CurvedChart, RunsCounterClockwiseCoversTheTissuesAreaAndTellsItsDistortion) {
  for (const double radius : {0.5, 0.8, 5.0}) {
    const Surface dome(dome_mesh(12, radius));
    const Chart& chart = dome.chart();
    double area = 0.0, least = 1.0, greatest = 1.0;
    for (int f = 0; f < dome.face_count(); ++f) {
      const double ratio = signed_area(chart.uv, dome.triangle(f)) / dome.face_area(f);
      EXPECT_GT(ratio, 0.0);
      area += ratio * dome.face_area(f);
      least = std::min(least, ratio);
      greatest = std::max(greatest, ratio);
    }
    EXPECT_NEAR(area, dome.area(), 1e-12);
    EXPECT_NEAR(chart.distortion.least_area_ratio, least, 1e-12);
    EXPECT_NEAR(chart.distortion.greatest_area_ratio, greatest, 1e-12);
    EXPECT_FALSE(chart.isometric);
    for (int f = 0; f < dome.face_count(); ++f) {
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector3i t = dome.triangle(f);
        const double stretch = (chart.uv.row(t[i]) - chart.uv.row(t[(i + 1) % 3])).norm() /
                               (dome.vertex(t[i]) - dome.vertex(t[(i + 1) % 3])).norm();
        EXPECT_GT(stretch, chart.distortion.least_stretch - 1e-12);
        EXPECT_LT(stretch, chart.distortion.greatest_stretch + 1e-12);
      }
    }
    // A disk of angle a on a sphere: its border is sin(a) / a too short for its radius.
    EXPECT_LT(chart.distortion.rms_stretch_error, 0.03 / (radius * radius));
  }
}

/// Liu et al. (2008) as written: rotations by singular values, then the vertices by a dense solve,
/// over and over.
Points2 local_global(const TriangleMesh& mesh, Points2 uv, int rounds) {
  const Eigen::Index n = mesh.vertices.rows();
  struct Flat {
    Eigen::Matrix<double, 2, 3> x;
    Vec3 cotangent;  // at the corner opposite of the edge from corner i to the next
  };
  std::vector<Flat> flat;
  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(n, n);
  for (const auto& t : mesh.triangles.rowwise()) {
    Flat& f = flat.emplace_back();
    const Vec3 b = mesh.vertices.row(t[1]) - mesh.vertices.row(t[0]),
               c = mesh.vertices.row(t[2]) - mesh.vertices.row(t[0]);
    const Vec3 ahead = b.normalized();
    f.x << 0.0, b.norm(), ahead.dot(c), 0.0, 0.0, ahead.cross(c).norm();
    for (int i = 0; i < 3; ++i) {
      const Vec3 p = mesh.vertices.row(t[(i + 2) % 3]), q = mesh.vertices.row(t[i]),
                 r = mesh.vertices.row(t[(i + 1) % 3]);
      f.cotangent[i] = (q - p).dot(r - p) / (q - p).cross(r - p).norm();
      const int a = t[i], d = t[(i + 1) % 3];
      laplacian(a, a) += f.cotangent[i];
      laplacian(d, d) += f.cotangent[i];
      laplacian(a, d) -= f.cotangent[i];
      laplacian(d, a) -= f.cotangent[i];
    }
  }
  laplacian(0, 0) += 1.0;  // the first vertex at the origin
  const Eigen::LDLT<Eigen::MatrixXd> solver(laplacian);
  for (int round = 0; round < rounds; ++round) {
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(n, 2);
    for (Eigen::Index face = 0; face < mesh.triangles.rows(); ++face) {
      const auto t = mesh.triangles.row(face);
      const Flat& f = flat[face];
      Eigen::Matrix2d s = Eigen::Matrix2d::Zero();
      for (int i = 0; i < 3; ++i)
        s += f.cotangent[i] * (uv.row(t[i]) - uv.row(t[(i + 1) % 3])).transpose() *
             (f.x.col(i) - f.x.col((i + 1) % 3)).transpose();
      const Eigen::JacobiSVD<Eigen::Matrix2d> svd(s, Eigen::ComputeFullU | Eigen::ComputeFullV);
      const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant();
      const Eigen::Matrix2d rotation =
          svd.matrixU() * Vec2(1.0, sign).asDiagonal() * svd.matrixV().transpose();
      for (int i = 0; i < 3; ++i) {
        const Vec2 pull = f.cotangent[i] * rotation * (f.x.col(i) - f.x.col((i + 1) % 3));
        right.row(t[i]) += pull.transpose();
        right.row(t[(i + 1) % 3]) -= pull.transpose();
      }
    }
    uv = solver.solve(right);
  }
  return uv;
}

TEST(CurvedChart, IsWhereLocalAndGlobalStepsEnd) {
  const TriangleMesh mesh = dome_mesh(6);
  const Surface dome(mesh);
  Points2 slow = local_global(mesh, mesh.vertices.leftCols<2>(), 3000);
  double area = 0.0;
  for (int f = 0; f < dome.face_count(); ++f) area += signed_area(slow, dome.triangle(f));
  slow *= std::sqrt(dome.area() / area);
  EXPECT_LT(difference(dome.chart().uv, slow), 1e-9);
}

TEST(CurvedChart, HasItsOriginAtTheVertexNearestToTheCentroidAndUAlongX) {
  const Surface dome(dome_mesh(20, 2.0));
  const Points2& uv = dome.chart().uv;
  int origin = -1;
  for (int v = 0; v < dome.vertex_count(); ++v) {
    if (uv.row(v).norm() == 0.0) origin = v;
  }
  ASSERT_GE(origin, 0);
  // Around the origin u runs along x and v along y, but for the curvature over an edge and the
  // small stretch there.
  for (int v = 0; v < dome.vertex_count(); ++v) {
    const Vec3 arm = dome.vertex(v) - dome.vertex(origin);
    if (arm.norm() < 0.15) {
      EXPECT_NEAR(uv(v, 0), arm.x(), 0.01);
      EXPECT_NEAR(uv(v, 1), arm.y(), 0.01);
    }
  }
}

TEST(CurvedChart, IsTheSameUnderAnyNamesOfVerticesAndFaces) {
  const TriangleMesh mesh = dome_mesh(9);
  Random random(8);
  const std::vector<int> names = zoo::shuffled(static_cast<int>(mesh.vertices.rows()), random);
  const Surface dome(mesh), other(zoo::reordered(zoo::relabelled(mesh, names), random));
  for (int v = 0; v < dome.vertex_count(); ++v)
    EXPECT_LT((dome.chart().uv.row(v) - other.chart().uv.row(names[v])).norm(),
              1e-9);  // the promise; rounding gives 1e-11
}

TEST(CurvedChart, MovesWithTheTissueAndScalesWithIt) {
  const TriangleMesh mesh = dome_mesh(9);
  const Points2 uv = Surface(mesh).chart().uv;
  const Eigen::Matrix3d same = Eigen::Matrix3d::Identity();
  for (const double scale : {1e-3, 1e3})
    EXPECT_LT((Surface(zoo::moved(mesh, same, Vec3::Zero(), scale)).chart().uv / scale - uv).norm(),
              1e-9);
  EXPECT_LT((Surface(zoo::moved(mesh, same, Vec3(1.0, 2.0, 3.0))).chart().uv - uv).norm(), 1e-9);
  // Turned, its x axis is another direction on the tissue: the same chart, turned.
  EXPECT_LT(
      difference(Surface(zoo::moved(mesh, zoo::some_rotation(), Vec3(1.0, 2.0, 3.0))).chart().uv,
                 uv),
      1e-9);
}

TEST(CurvedChart, IsRefusedWithTheLoopsHandlesOrComponentsInTheWay) {
  EXPECT_NE(refusal(zoo::icosphere_mesh(1)).find("no border (it is closed)"), std::string::npos);
  EXPECT_NE(refusal(zoo::torus_mesh(2.0, 0.7, 12, 8)).find("1 handle, no border"),
            std::string::npos);
  EXPECT_NE(refusal(zoo::cylinder_mesh(1.0, 2.0, 12, 5)).find("2 border loops"), std::string::npos);
  EXPECT_NE(refusal(zoo::cylinder_mesh(1.0, 2.0, 12, 5)).find("mm long around ("),
            std::string::npos);
  EXPECT_NE(refusal(zoo::together(dome_mesh(4),
                                  zoo::moved(dome_mesh(4), zoo::some_rotation(), Vec3(5, 0, 0))))
                .find("2 components, 2 border"),
            std::string::npos);
}

// A ramp that winds around once and a tenth, rising: a disk, and each place of it is flat enough,
// but the sheet would lie over itself.
TEST(CurvedChart, IsRefusedWhereTheFlattenedSheetLiesOverItself) {
  const TriangleMesh ramp = zoo::rolled_grid_mesh(60, 3, false, false, [](double u, double v) {
    const double angle = -2.2 * std::numbers::pi * u, radius = 1.0 + v;
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), 0.3 * u);
  });
  EXPECT_TRUE(Surface(ramp).has_chart());
  EXPECT_NE(refusal(ramp).find("lies over itself at u ="), std::string::npos) << refusal(ramp);
}

// All of a sphere but a cap: the map is far from rigid, yet no triangle is turned over.
TEST(CurvedChart, TurnsNothingOverOnAnAlmostClosedBall) {
  TriangleMesh ball = zoo::icosphere_mesh(2);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index f = 0; f < ball.triangles.rows(); ++f) {
    const auto t = ball.triangles.row(f);
    if (std::max({ball.vertices(t[0], 2), ball.vertices(t[1], 2), ball.vertices(t[2], 2)}) < 0.75)
      kept.push_back(f);
  }
  std::vector<int> names(ball.vertices.rows(), -1);
  TriangleMesh open{Points(0, 3), Triangles(static_cast<Eigen::Index>(kept.size()), 3)};
  for (std::size_t f = 0; f < kept.size(); ++f) {
    for (int i = 0; i < 3; ++i) {
      int& name = names[ball.triangles(kept[f], i)];
      if (name < 0) {
        name = static_cast<int>(open.vertices.rows());
        open.vertices.conservativeResize(name + 1, 3);
        open.vertices.row(name) = ball.vertices.row(ball.triangles(kept[f], i));
      }
      open.triangles(static_cast<Eigen::Index>(f), i) = name;
    }
  }
  const Surface surface(open);
  ASSERT_TRUE(surface.has_chart());
  for (int f = 0; f < surface.face_count(); ++f)
    EXPECT_GT(signed_area(surface.chart().uv, surface.triangle(f)), 0.0);
  EXPECT_GT(surface.chart().distortion.greatest_stretch, 1.5);
}

// A face split by a vertex a hair beside its edge: the cotangents there are 1e9, and drown nothing.
TEST(CurvedChart, SurvivesASliver) {
  TriangleMesh mesh = dome_mesh(6);
  const Points2 uv = Surface(mesh).chart().uv;
  const Eigen::Index n = mesh.vertices.rows(), m = mesh.triangles.rows();
  const Eigen::Vector3i t = mesh.triangles.row(10);
  mesh.vertices.conservativeResize(n + 1, 3);
  mesh.vertices.row(n) = (0.5 - 1e-9) * mesh.vertices.row(t[0]) + 0.5 * mesh.vertices.row(t[1]) +
                         1e-9 * mesh.vertices.row(t[2]);
  mesh.triangles.conservativeResize(m + 2, 3);
  const int middle = static_cast<int>(n);
  mesh.triangles.row(10) << t[0], t[1], middle;
  mesh.triangles.row(m) << t[1], t[2], middle;
  mesh.triangles.row(m + 1) << t[2], t[0], middle;
  const Surface surface(mesh);
  for (int f = 0; f < surface.face_count(); ++f)
    EXPECT_GT(signed_area(surface.chart().uv, surface.triangle(f)), 0.0);
  EXPECT_LT((surface.chart().uv.topRows(n) - uv).cwiseAbs().maxCoeff(), 1e-2);
}

}  // namespace
}  // namespace palpation
