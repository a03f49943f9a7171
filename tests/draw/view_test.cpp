#include "draw/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "draw/sheet.h"
#include "draw/tissue.h"

namespace palpation::draw {
namespace {

constexpr double kRounding_mm = 1e-9;

TEST(View, LooksAtAPlaneFromAboveWithItsAxes) {
  const View view = view_of(outcome_on_rectangle(0.02, 0.05), std::nullopt);
  EXPECT_TRUE(view.flat);
  EXPECT_TRUE(view.to_view_mm({0.02, 0.05, 0.0}).isApprox(Vec3(20.0, 50.0, 0.0)));
  const double margin = 0.008 * 50.0;  // of the longer side
  EXPECT_NEAR(view.width_mm, 20.0 + 2.0 * margin, kRounding_mm);
  EXPECT_NEAR(view.height_mm, 50.0 + 2.0 * margin, kRounding_mm);
  EXPECT_NEAR(view.left_mm, -margin, kRounding_mm);
}

TEST(View, HasTheSidesOfTheBorderAndNoOthers) {
  const View view = view_of(outcome_on_rectangle(0.02, 0.05), std::nullopt);
  EXPECT_EQ(view.rim_mm.size(), 16u);  // four cells along each of four sides
  double length = 0.0;
  for (const auto& [from, to] : view.rim_mm) length += (to - from).norm();
  EXPECT_NEAR(length, 140.0, kRounding_mm);
}

TEST(View, SeesATiltedPlaneAsFlatAndInItsTrueSize) {
  Outcome outcome = outcome_on_rectangle(0.02, 0.05);
  const double tilt = std::numbers::pi / 3.0;  // about the x axis, which stays to the right
  vtkPoints& points = *outcome.surface->GetPoints();
  for (vtkIdType i = 0; i < points.GetNumberOfPoints(); ++i) {
    const Vec3 p(points.GetPoint(i));
    points.SetPoint(i, p.x(), p.y() * std::cos(tilt), p.y() * std::sin(tilt));
  }
  const View view = view_of(outcome, std::nullopt);
  EXPECT_TRUE(view.flat);
  const double margin = 0.008 * 50.0;
  EXPECT_NEAR(view.width_mm, 20.0 + 2.0 * margin, kRounding_mm);
  EXPECT_NEAR(view.height_mm, 50.0 + 2.0 * margin, kRounding_mm);
}

// The square has sides of half of 50 mm: 1.3 times that and 4 mm are 36.5 mm.
TEST(ZoomedTo, HoldsTheCurveWithRoomAndStaysInTheWhole) {
  const Outcome outcome = outcome_on_rectangle(0.06, 0.05);
  const View whole = view_of(outcome, std::nullopt);
  const View part = zoomed_to(whole, outcome, {"estimate"});
  EXPECT_NEAR(part.width_mm, 36.5, kRounding_mm);
  EXPECT_NEAR(part.height_mm, 36.5, kRounding_mm);
  EXPECT_GE(part.left_mm, whole.left_mm);
  EXPECT_LE(part.left_mm + part.width_mm, whole.left_mm + whole.width_mm);
  EXPECT_LE(part.left_mm, 12.5);
  EXPECT_GE(part.left_mm + part.width_mm, 37.5);
}

TEST(ZoomedTo, IsTheWholeWhereThereIsNoSuchCurve) {
  const Outcome outcome = outcome_on_rectangle(0.06, 0.05);
  const View whole = view_of(outcome, std::nullopt);
  EXPECT_EQ(zoomed_to(whole, outcome, {"truth"}).width_mm, whole.width_mm);
}

TEST(ZoomedTo, IsTheWholeWhereTheCurveFillsItWhateverIsRounded) {
  Outcome outcome = outcome_on_rectangle(0.06, 0.05);
  const View whole = view_of(outcome, std::nullopt);
  outcome.curves = {{"estimate", {{0, 0, 0}, {0.06, 0, 0}, {0.06, 0.05, 0}, {0, 0.05, 0}}}};
  for (int nth = 1; nth < 300; ++nth) {
    View shifted = whole;
    shifted.left_mm = -0.0173 * nth;
    shifted.width_mm = 60.0 + 0.0311 * nth;
    const View part = zoomed_to(shifted, outcome, {"estimate"});
    EXPECT_EQ(part.left_mm, shifted.left_mm);
    EXPECT_EQ(part.width_mm, shifted.width_mm);
  }
}

TEST(Dashes, AreAsLongAsTheirGapsAndGoAroundCorners) {
  // Ten along x, then ten along y, in dashes of four: 0-4, 8-12 (around the corner), 16-20.
  const auto pieces = dashes({{0, 0, 0}, {10, 0, 0}, {10, 10, 0}}, 4.0);
  ASSERT_EQ(pieces.size(), 3u);
  EXPECT_EQ(pieces[0].back(), Eigen::Vector3d(4, 0, 0));
  EXPECT_EQ(pieces[1], (std::vector<Eigen::Vector3d>{{8, 0, 0}, {10, 0, 0}, {10, 2, 0}}));
  EXPECT_EQ(pieces[2].back(), Eigen::Vector3d(10, 10, 0));
}

TEST(Dashes, OfNoLengthAreTheWholeLine) {
  EXPECT_EQ(dashes({{0, 0, 0}, {10, 0, 0}}, 0.0).size(), 1u);
}

TEST(Circle, HasAllCornersOnIt) {
  for (const Pixel& corner : circle({3.0, 4.0}, 5.0))
    EXPECT_NEAR((corner - Pixel(3.0, 4.0)).norm(), 5.0, 1e-12);
}

}  // namespace
}  // namespace palpation::draw
