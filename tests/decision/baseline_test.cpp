#include "palpation/decision/baseline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>

#include "decision/tissue.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

std::vector<Vec3> positions(const Surface& surface, const std::vector<SurfacePoint>& points) {
  std::vector<Vec3> places;
  for (const SurfacePoint& point : points) places.push_back(surface.position(point));
  return places;
}

// 4 x 10 mm, three rows of eleven places along y, to and fro: 3 x 10 mm and two changes of 2 mm
// make 34 mm.
TEST(RasterScan, GoesToAndFroAlongTheLongerSide) {
  const Surface tissue = sheet(0.004, 0.010, 0.001);
  const std::vector<Vec3> places = positions(tissue, raster_scan(tissue, 0.002, 0.001));
  ASSERT_EQ(places.size(), 33u);
  double length = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i) length += (places[i] - places[i - 1]).norm();
  EXPECT_NEAR(length, 0.034, 1e-12);  // rounding
  EXPECT_LT((places[10] - Vec3(0.0, 0.010, 0.0)).norm(), 1e-12);
  EXPECT_LT((places[11] - Vec3(0.002, 0.010, 0.0)).norm(), 1e-12);
  EXPECT_LT((places[32] - Vec3(0.004, 0.010, 0.0)).norm(), 1e-12);
}

// 2 mm fit twice into 5 mm: the millimetre that is left over is shared, so rows are at 0.5, 2.5
// and 4.5 mm. Places every 4 mm of 10 mm: 1, 5, 9.
TEST(RasterScan, SharesOutWhatIsLeftOverAtBothEnds) {
  const Surface tissue = sheet(0.010, 0.005, 0.001);
  const std::vector<Vec3> places = positions(tissue, raster_scan(tissue, 0.002, 0.004));
  ASSERT_EQ(places.size(), 9u);
  EXPECT_LT((places[0] - Vec3(0.001, 0.0005, 0.0)).norm(), 1e-12);
  EXPECT_LT((places[4] - Vec3(0.005, 0.0025, 0.0)).norm(), 1e-12);
  EXPECT_LT((places[8] - Vec3(0.009, 0.0045, 0.0)).norm(), 1e-12);
}

// 9 x 9 places at whole millimetres of a square of 8 mm; the quarter that is cut away held 4 x 4 of
// them, its sides still belong to the tissue.
TEST(RasterScan, LeavesOutPlacesOffTheTissue) {
  const Surface shape = l_shape(0.008, 8);
  const std::vector<Vec3> places = positions(shape, raster_scan(shape, 0.001, 0.001));
  EXPECT_EQ(places.size(), 81u - 16u);
  for (const Vec3& place : places) EXPECT_FALSE(place.x() > 0.0041 && place.y() > 0.0041);
}

TEST(RasterScan, RefusesStepsThatAreNoLengthsAndScansWithoutEnd) {
  const Surface tissue = sheet(0.004, 0.010, 0.001);
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(raster_scan(tissue, bad, 0.001), InvalidInput) << bad;
    EXPECT_THROW(raster_scan(tissue, 0.001, bad), InvalidInput) << bad;
  }
  EXPECT_THROW(raster_scan(tissue, 1e-9, 1e-9), InvalidInput);
}

Palpation felt(const SurfacePoint& where, double reading) {
  Palpation palpation;
  palpation.where = where;
  palpation.reading = reading;
  return palpation;
}

using Feel = std::function<double(const Vec3&)>;

/// Readings by place in tenths of micrometres.
using Touched = std::map<std::pair<long, long>, double>;

std::pair<long, long> tenths_of_micrometres(double x_m, double y_m) {
  return {std::lround(1e7 * x_m), std::lround(1e7 * y_m)};
}

/// Refines to the end; a place that is asked for twice fails the test.
Touched refine_by_touch(RecursiveRefinement refinement, const Surface& surface, double level,
                        const Feel& feel) {
  Touched touched;
  for (std::vector<SurfacePoint> places = refinement.next(level); !places.empty();
       places = refinement.next(level)) {
    std::vector<Palpation> palpations;
    for (const SurfacePoint& place : places) {
      const Vec3 p = surface.position(place);
      palpations.push_back(felt(place, feel(p)));
      EXPECT_TRUE(
          touched.emplace(tenths_of_micrometres(p.x(), p.y()), palpations.back().reading).second)
          << "asked for twice";
    }
    refinement.record(palpations);
  }
  return touched;
}

// The paper's disk on its phantom: inside 9, outside 7. The finest grid, 0.3125 mm, would need 81 x
// 161 = 13,041 touches. Cells of 2.5 mm are small beside the disk's radius of 6.25 mm, so that no
// part of this outline slips in and out between two neighbouring corners.
TEST(RecursiveRefinement, FindsTheWholeOutlineOfADiskWithATenthOfTheTouches) {
  const Surface phantom = sheet(0.025, 0.050, 0.0025);
  const auto feel = [](const Vec3& p) {
    return (p - Vec3(0.011492, 0.030, 0.0)).norm() < 0.00625 ? 9.0 : 7.0;
  };
  const Touched touched =
      refine_by_touch(RecursiveRefinement(phantom, 0.0025, 0.0003125), phantom, 8.0, feel);
  EXPECT_LT(touched.size(), 1304u);
  EXPECT_GT(touched.size(), 11u * 21u);  // the coarse grid
  const double step = 0.0003125;
  int straddling = 0;
  for (int column = 0; column < 80; ++column) {
    for (int row = 0; row < 160; ++row) {
      int inside = 0, felt = 0;
      for (const auto& [i, j] :
           {std::pair(0, 0), std::pair(1, 0), std::pair(0, 1), std::pair(1, 1)}) {
        const double x = (column + i) * step, y = (row + j) * step;
        inside += feel(Vec3(x, y, 0.0)) > 8.0;
        felt += static_cast<int>(touched.count(tenths_of_micrometres(x, y)));
      }
      if (inside == 0 || inside == 4) continue;
      ++straddling;
      EXPECT_EQ(felt, 4) << "cell " << column << ", " << row;
    }
  }
  EXPECT_GT(straddling, 100);  // the outline is 126 steps long
}

// 4 x 4 mm in cells of 2 mm: nine corners, all alike.
TEST(RecursiveRefinement, TouchesTheCoarseGridOnlyWhereNothingStraddlesTheLevel) {
  const Surface tissue = sheet(0.004, 0.004, 0.001);
  const Touched touched = refine_by_touch(RecursiveRefinement(tissue, 0.002, 0.0005), tissue, 8.0,
                                          [](const Vec3&) { return 7.0; });
  EXPECT_EQ(touched.size(), 9u);
}

// A straight edge at x = 1.2 mm on 4 x 2 mm, cells of 2 mm down to 1 mm: six corners; then the left
// cell is cut, five places more.
TEST(RecursiveRefinement, CutsACellInFour) {
  const Surface tissue = sheet(0.004, 0.002, 0.001);
  const auto feel = [](const Vec3& p) { return p.x() > 0.0012 ? 9.0 : 7.0; };
  const Touched touched =
      refine_by_touch(RecursiveRefinement(tissue, 0.002, 0.001), tissue, 8.0, feel);
  EXPECT_EQ(touched.size(), 11u);
  EXPECT_EQ(touched.count(tenths_of_micrometres(0.001, 0.001)), 1u);
  EXPECT_EQ(touched.count(tenths_of_micrometres(0.003, 0.001)), 0u);
}

// 5 mm in cells of 2 mm: corners at 0, 2, 4 and 5 mm, both ways.
TEST(RecursiveRefinement, ShortensTheLastCellsToFit) {
  const Surface tissue = sheet(0.005, 0.005, 0.001);
  const Touched touched = refine_by_touch(RecursiveRefinement(tissue, 0.002, 0.002), tissue, 8.0,
                                          [](const Vec3&) { return 7.0; });
  EXPECT_EQ(touched.size(), 16u);
  EXPECT_EQ(touched.count(tenths_of_micrometres(0.005, 0.005)), 1u);
  EXPECT_EQ(touched.count(tenths_of_micrometres(0.004, 0.002)), 1u);
}

// Of the nine corners of 2 x 2 cells on three quarters of a square one is off the tissue.
TEST(RecursiveRefinement, AsksForNothingOffTheTissue) {
  const Surface shape = l_shape(0.004, 4);
  EXPECT_EQ(RecursiveRefinement(shape, 0.002, 0.002).next(8.0).size(), 8u);
}

// The right corners give no answer; what is left does not straddle the level, so the only cell is
// not cut.
TEST(RecursiveRefinement, DoesNotAskAgainWhereNothingWasFelt) {
  const Surface tissue = sheet(0.002, 0.002, 0.001);
  RecursiveRefinement refinement(tissue, 0.002, 0.001);
  std::vector<Palpation> palpations;
  for (const SurfacePoint& place : refinement.next(8.0)) {
    if (tissue.position(place).x() < 0.001) palpations.push_back(felt(place, 7.0));
  }
  ASSERT_EQ(palpations.size(), 2u);
  refinement.record(palpations);
  EXPECT_TRUE(refinement.next(8.0).empty());
}

// Corners felt 7, 7, 9, 9: nothing to do for a level of 10, but the cell is cut, five places, when
// the level turns out to be 8.
TEST(RecursiveRefinement, FollowsALevelThatMoves) {
  const Surface tissue = sheet(0.002, 0.002, 0.001);
  RecursiveRefinement refinement(tissue, 0.002, 0.001);
  std::vector<Palpation> palpations;
  for (const SurfacePoint& place : refinement.next(10.0)) {
    palpations.push_back(felt(place, tissue.position(place).x() < 0.001 ? 7.0 : 9.0));
  }
  refinement.record(palpations);
  EXPECT_TRUE(refinement.next(10.0).empty());
  EXPECT_EQ(refinement.next(8.0).size(), 5u);
}

TEST(RecursiveRefinement, RefusesWhatItDidNotAskForAndReadingsThatAreNoNumbers) {
  const Surface tissue = sheet(0.004, 0.004, 0.001);
  RecursiveRefinement refinement(tissue, 0.002, 0.001);
  const std::vector<SurfacePoint> places = refinement.next(8.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(refinement.record(std::vector<Palpation>{felt(places[0], nan)}), InvalidInput);
  EXPECT_THROW(refinement.record(std::vector<Palpation>{felt(tissue.at_vertex(6), 7.0)}),
               InvalidInput);  // at (1, 1) mm
  refinement.record(std::vector<Palpation>{felt(places[0], 7.0)});
  EXPECT_THROW(refinement.record(std::vector<Palpation>{felt(places[0], 7.0)}), InvalidInput);
  EXPECT_THROW(refinement.next(nan), InvalidInput);
}

TEST(RecursiveRefinement, RefusesCellsThatDoNotGetFinerOrAreTooMany) {
  const Surface tissue = sheet(0.004, 0.004, 0.001);
  EXPECT_THROW(RecursiveRefinement(tissue, 0.001, 0.002), InvalidInput);
  EXPECT_THROW(RecursiveRefinement(tissue, 0.001, 0.0), InvalidInput);
  EXPECT_THROW(RecursiveRefinement(tissue, std::numeric_limits<double>::infinity(), 0.001),
               InvalidInput);
  EXPECT_THROW(RecursiveRefinement(tissue, 1e300, 0.001), InvalidInput);
  EXPECT_THROW(RecursiveRefinement(tissue, 0.001, 1e-7), InvalidInput);
}

}  // namespace
}  // namespace palpation
