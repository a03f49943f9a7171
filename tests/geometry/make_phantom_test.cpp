#include "palpation/geometry/make_phantom.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/self_intersection.h"
#include "palpation/base/error.h"
#include "palpation/geometry/surface.h"

namespace palpation {
namespace {

constexpr double kPi = std::numbers::pi;

struct Named {
  const char* name;
  Sheet sheet;
};

std::vector<Named> all_sheets() {
  return {{"cylinder", cylinder_sheet()},
          {"dome", dome_sheet()},
          {"saddle", saddle_sheet()},
          {"wave", wave_sheet()},
          {"folded", folded_sheet()},
          {"more than half a cylinder", cylinder_sheet({.radius_m = 0.005})},
          {"almost a sphere", dome_sheet({.radius_m = 0.010, .reach_m = 0.028})},
          {"narrow fold", folded_sheet({.gap_m = 0.00075})}};
}

PhantomMesh mesh_of(const Sheet& sheet, double edge_m, double jitter = 0.3,
                    std::uint64_t seed = 1) {
  Random random(seed);
  return make_phantom(sheet, edge_m, jitter, random);
}

Vec2 middle_of(const Sheet& sheet) { return sheet.corner_m + 0.5 * sheet.size_m; }

/// Derivatives of the position by central differences.
std::pair<Vec3, Vec3> tangents(const Sheet& sheet, const Vec2& p) {
  const double h = 1e-7;
  const Vec2 s(h, 0.0), t(0.0, h);
  return {(sheet.position(p + s) - sheet.position(p - s)) / (2.0 * h),
          (sheet.position(p + t) - sheet.position(p - t)) / (2.0 * h)};
}

TEST(Sheets, HaveNormalsAcrossBothTangents) {
  for (const Named& named : all_sheets()) {
    Random random(1);
    for (int k = 0; k < 200; ++k) {
      const Vec2 reach(random.uniform() - 0.5, random.uniform() - 0.5);
      const Vec2 p = middle_of(named.sheet) + 0.7 * reach.cwiseProduct(named.sheet.size_m);
      const auto [s, t] = tangents(named.sheet, p);
      // Differences of step 1e-7 m: at the start of a bend of 0.75 mm they are off by 1e-7 / 7.5e-4
      // at most.
      EXPECT_NEAR((named.sheet.normal(p) - s.cross(t).normalized()).norm(), 0.0, 3e-4)
          << named.name;
    }
  }
}

TEST(Sheets, UnrollWithoutStretching) {
  for (const Named& named : all_sheets()) {
    if (!named.sheet.unrolled) continue;
    Random random(2);
    for (int k = 0; k < 200; ++k) {
      const Vec2 p = named.sheet.corner_m +
                     Vec2(random.uniform(), random.uniform()).cwiseProduct(named.sheet.size_m);
      const Vec2 step = 1e-6 * Vec2(random.normal(), random.normal());
      const double along = (named.sheet.position(p + step) - named.sheet.position(p - step)).norm();
      const double flat = (named.sheet.unrolled(p + step) - named.sheet.unrolled(p - step)).norm();
      EXPECT_NEAR(along / flat, 1.0, 1e-5)
          << named.name;  // a chord of 2e-6 m over the start of a bend
    }
  }
}

TEST(Sheets, FoldedComesAsCloseAsItsGapAndIsFortyMillimetresAwayAlongTheSurface) {
  const Sheet folded = folded_sheet();
  const double bend = kPi * 0.00075;
  const Vec3 on_first = folded.position({0.001, 0.01}),
             facing = folded.position({0.039 + bend, 0.01});
  EXPECT_NEAR((facing - on_first - Vec3(0.0, 0.0, 0.0015)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((folded.unrolled({0.039 + bend, 0.01}) - folded.unrolled({0.001, 0.01})).norm(),
              0.038 + bend, 1e-15);
  EXPECT_GT((folded.unrolled({0.040 + bend, 0.0}) - folded.unrolled({0.0, 0.0})).norm(), 0.040);
}

TEST(MakePhantom, MakesDisksThatDoNotTouchThemselvesWithOutwardNormals) {
  for (const Named& named : all_sheets()) {
    for (const double jitter : {0.0, 0.3, 0.45}) {
      const PhantomMesh phantom = mesh_of(named.sheet, 0.001, jitter);
      const Surface surface(phantom.mesh);
      EXPECT_TRUE(surface.topology().is_disk()) << named.name;
      EXPECT_FALSE(surface.is_planar()) << named.name;
      EXPECT_EQ(self_intersections(surface).pairs, 0) << named.name << " " << jitter;
      for (int v = 0; v < surface.vertex_count(); ++v) {
        const Vec2 p = phantom.parameters.row(v);
        EXPECT_NEAR((surface.vertex(v) - named.sheet.position(p)).norm(), 0.0, 1e-15) << named.name;
      }
    }
  }
}

TEST(MakePhantom, HasNormalsWithinADegreeOfTheTrueOnesAtAQuarterOfAMillimetre) {
  for (const auto& [name, sheet] :
       {Named{"cylinder", cylinder_sheet()}, Named{"dome", dome_sheet()},
        Named{"saddle", saddle_sheet()}, Named{"wave", wave_sheet()}}) {
    const PhantomMesh phantom = mesh_of(sheet, 0.00025);
    const Surface surface(phantom.mesh);
    double worst = 0.0;
    for (int v = 0; v < surface.vertex_count(); ++v) {
      const Vec3 normal = surface.vertex_normals().row(v),
                 truth = sheet.normal(phantom.parameters.row(v));
      worst = std::max(worst, std::atan2(normal.cross(truth).norm(), normal.dot(truth)));
    }
    EXPECT_LT(worst * 180.0 / kPi, 1.0) << name;
  }
}

TEST(MakePhantom, IsAsLargeAsTheSheet) {
  // Chords are shorter than arcs: an area is too small by about (edge / radius)^2 / 6.
  const auto area = [](const Sheet& sheet) { return Surface(mesh_of(sheet, 0.0005).mesh).area(); };
  EXPECT_NEAR(area(cylinder_sheet()) / (0.025 * 0.050), 1.0, 2e-4);
  EXPECT_NEAR(area(dome_sheet()) / (2.0 * kPi * 0.025 * 0.025 * (1.0 - std::cos(0.0205 / 0.025))),
              1.0, 5e-4);
  const Sheet wave = wave_sheet();
  EXPECT_NEAR(area(wave) / (0.025 * wave.unrolled({0.0, 0.050}).y()), 1.0, 3e-4);
  EXPECT_NEAR(area(folded_sheet({.gap_m = 0.003})) / (0.025 * (0.060 + kPi * 0.003)), 1.0, 3e-3);
}

TEST(MakePhantom, IsIrregularAndTheSameForTheSameSeed) {
  const PhantomMesh once = mesh_of(dome_sheet(), 0.001), again = mesh_of(dome_sheet(), 0.001),
                    other = mesh_of(dome_sheet(), 0.001, 0.3, 2);
  EXPECT_EQ(once.mesh.vertices, again.mesh.vertices);
  EXPECT_EQ(once.mesh.triangles, again.mesh.triangles);
  EXPECT_NE(once.mesh.vertices, other.mesh.vertices);
  Eigen::VectorXi valence = Eigen::VectorXi::Zero(once.mesh.vertices.rows());
  for (const int corner : once.mesh.triangles.reshaped()) ++valence[corner];
  EXPECT_GE(valence.maxCoeff(), 8);
}

TEST(MakePhantom, RefusesWhatIsNoSheet) {
  EXPECT_THROW(cylinder_sheet({.radius_m = 0.001}), InvalidInput);  // 25 mm are four times around
  EXPECT_THROW(dome_sheet({.radius_m = 0.001}), InvalidInput);
  EXPECT_THROW(saddle_sheet({.radius_m = -1.0}), InvalidInput);
  EXPECT_THROW(wave_sheet({.wavelength_m = 0.0}), InvalidInput);
  EXPECT_THROW(folded_sheet({.gap_m = std::numeric_limits<double>::quiet_NaN()}), InvalidInput);
  EXPECT_THROW(mesh_of(dome_sheet(), 0.0), InvalidInput);
  EXPECT_THROW(mesh_of(dome_sheet(), 1e-7), InvalidInput);
  EXPECT_THROW(mesh_of(dome_sheet(), 0.001, 0.5), InvalidInput);
}

}  // namespace
}  // namespace palpation
