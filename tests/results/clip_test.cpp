#include "results/clip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "palpation/base/error.h"
#include "results/parts.h"

namespace palpation::results {
namespace {

/// A square of side 3 mm in nine cells, two triangles each, whose field is x in millimetres.
Tissue square() {
  Tissue tissue;
  tissue.mesh.vertices.resize(16, 3);
  Field x(16), twice(16);
  for (int i = 0; i < 16; ++i) {
    tissue.mesh.vertices.row(i) << 1e-3 * (i % 4), 1e-3 * (i / 4), 0.0;
    x[i] = i % 4;
    twice[i] = 2.0 * (i % 4);
  }
  tissue.mesh.triangles.resize(18, 3);
  for (int cell = 0; cell < 9; ++cell) {
    const int a = 4 * (cell / 3) + cell % 3;
    tissue.mesh.triangles.row(2 * cell) << a, a + 1, a + 5;
    tissue.mesh.triangles.row(2 * cell + 1) << a, a + 5, a + 4;
  }
  tissue.fields = {{"x", x}, {"twice", twice}};
  return tissue;
}

TEST(Clip, CutsTrianglesAlongTheLevelLine) {
  const VtpShape whole = model_of(square(), {"x", "twice"});
  EXPECT_NEAR(area_m2(whole), 9e-6, 1e-18);
  const VtpShape right = clipped(whole, "x", 1.25, Side::AtLeast);
  EXPECT_NEAR(area_m2(right), 1.75 * 3.0 * 1e-6, 1e-18);
  for (std::size_t i = 0; i < right.points.size(); ++i) {
    EXPECT_GE(right.points[i].x(), 1.25e-3 - 1e-15);
    EXPECT_NEAR(right.point_fields[1].second[i], 2e3 * right.points[i].x(), 1e-12);
  }
  const VtpShape strip = clipped(right, "x", 1.75, Side::AtMost);
  EXPECT_NEAR(area_m2(strip), 0.5 * 3.0 * 1e-6, 1e-18);
}

TEST(Clip, KeepsThePartInOnePieceAndTurnedAsItWas) {
  const VtpShape part = clipped(model_of(square(), {"x"}), "x", 0.5, Side::AtLeast);
  std::set<std::pair<double, double>> places;
  for (const Vec3& point : part.points) places.insert({point.x(), point.y()});
  EXPECT_EQ(places.size(), part.points.size());  // each crossing once
  for (const auto& [a, b, c] : part.triangles) {
    const Vec3 u = part.points[b] - part.points[a], v = part.points[c] - part.points[a];
    EXPECT_GE(u.x() * v.y() - u.y() * v.x(), 0.0);
  }
}

TEST(Clip, TakesAVertexAtTheLevelForInside) {
  const VtpShape whole = model_of(square(), {"x"});
  EXPECT_NEAR(area_m2(clipped(whole, "x", 0.0, Side::AtLeast)), 9e-6, 1e-18);
  EXPECT_NEAR(area_m2(clipped(whole, "x", 3.0, Side::AtMost)), 9e-6, 1e-18);
  EXPECT_TRUE(clipped(whole, "x", 3.5, Side::AtLeast).points.empty());
}

TEST(Clip, LeavesOutWhereTheFieldIsNoNumber) {
  Tissue tissue = square();
  tissue.fields["x"][0] = std::numeric_limits<double>::quiet_NaN();
  const VtpShape part = clipped(model_of(tissue, {"x"}), "x", -1.0, Side::AtLeast);
  EXPECT_NEAR(area_m2(part), 8e-6, 1e-18);  // both triangles of the corner's cell are gone
}

TEST(SearchedArea, IsThatOfThePartThatNoReadingIsNear) {
  results::Run run;
  run.tissue = square();
  for (auto vertex : run.tissue.mesh.vertices.rowwise()) vertex *= 20.0;  // 60 mm
  run.knows_touches = true;
  for (const Vec3& place : {Vec3(0.0, 0.0, 0.0), Vec3(0.06, 0.02, 0.0)})
    run.touches.push_back({.place = place, .reading = 1.0, .kind = "stop", .set_aside = ""});
  const auto [whole_m2, not_searched_m2] = searched_area(run);
  EXPECT_NEAR(whole_m2, 3600e-6, 1e-15);
  EXPECT_NEAR(not_searched_m2, area_m2(not_searched_of(run)), 1e-15);
  EXPECT_GT(not_searched_m2, 0.5 * whole_m2);
  EXPECT_LT(not_searched_m2, whole_m2);
  run.touches[1].set_aside = "a hand was in the way";
  EXPECT_GT(searched_area(run).not_searched_m2, not_searched_m2);
  run.touches.clear();
  EXPECT_EQ(searched_area(run).not_searched_m2, whole_m2);
}

TEST(Clip, RefusesAFieldThatIsNotThere) {
  EXPECT_THROW(clipped(model_of(square(), {"x"}), "y", 0.0, Side::AtLeast), InvalidInput);
}

}  // namespace
}  // namespace palpation::results
