#include "palpation/readings/screening.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "readings/tissue.h"

namespace palpation {
namespace {

/// Counts of a sensor on 30 x 50 mm of tissue with a disk of 8 mm radius, its edge felt by a tip of
/// several millimetres.
double counts(const Vec3& p) {
  return 7000.0 +
         1500.0 / (1.0 + std::exp(1400.0 * ((p - Vec3(0.012, 0.025, 0.0)).norm() - 0.008)));
}

Surface sheet() {
  Random random(0);
  return Surface(make_plane({.size_m = {0.030, 0.050}, .columns = 31, .rows = 51}, random));
}

struct Scan {
  Surface tissue = sheet();
  std::vector<Palpation> palpations;
  std::vector<int> row;  // of each palpation
  std::vector<double> y_m;
};

/// Ten rows along y, 3 mm apart, a reading every fifth of a millimetre. `change` is what the sensor
/// makes of a reading.
Scan scan(const std::function<double(double counts, int row, double y_m)>& change,
          double step_m = 0.0002, double noise = 0.1) {
  Scan made;
  Random random(1);
  for (int row = 0; row < 10; ++row) {
    for (double y_m = 0.0; y_m <= 0.050; y_m += step_m) {
      const Vec3 p(0.001 + 0.003 * row, y_m, 0.0);
      Palpation palpation;
      palpation.where = made.tissue.project(p);
      palpation.reading = change(counts(p) + noise * random.normal(), row, y_m);
      palpation.travel = Vec3::UnitY();
      made.palpations.push_back(palpation);
      made.row.push_back(row);
      made.y_m.push_back(y_m);
    }
  }
  return made;
}

std::map<std::string, int> reasons(const std::vector<Palpation>& palpations) {
  std::map<std::string, int> found;
  for (const Palpation& palpation : palpations) {
    if (!palpation.set_aside.empty()) ++found[palpation.set_aside];
  }
  return found;
}

using Found = std::map<std::string, int>;

Found found_in(const Scan& scan) { return reasons(screened(scan.tissue, scan.palpations)); }

/// Of the readings that satisfy a condition, how many have the reason; and of the others.
std::pair<int, int> inside_and_outside(const Scan& scan, const std::string& reason,
                                       const std::function<bool(int, double)>& condition) {
  const std::vector<Palpation> result = screened(scan.tissue, scan.palpations);
  std::pair<int, int> counted{0, 0};
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (result[i].set_aside == reason)
      ++(condition(scan.row[i], scan.y_m[i]) ? counted.first : counted.second);
  }
  return counted;
}

constexpr int kPerRow = 251;

TEST(Screened, ASoundScanIsLeftAlone) {
  EXPECT_EQ(found_in(scan([](double counts, int, double) { return counts; })), Found{});
  EXPECT_EQ(found_in(scan([](double counts, int, double) { return counts; }, 0.001, 0.0)),
            Found{});  // coarse, without noise
  EXPECT_EQ(found_in(scan([](double counts, int, double) { return counts; }, 0.001, 150.0)),
            Found{});  // a tenth of the contrast
  EXPECT_EQ(found_in(scan([](double counts, int row, double y_m) {
              return counts - 40.0 * row + 6000.0 * y_m;
            })),
            Found{});  // tilted
}

TEST(Screened, ContactThatFadesIsNoFault) {
  const Scan faded = scan([](double counts, int row, double) {
    return 7000.0 - 30.0 * row + (counts - 7000.0) * std::exp(-0.3 * row);
  });
  EXPECT_EQ(found_in(faded), Found{});
}

TEST(Screened, JammedRowsAreSetAsideThoughTheyAreMost) {
  const Scan jammed =
      scan([](double counts, int row, double) { return row >= 3 ? counts + 4000.0 : counts; });
  const auto [found, wrong] =
      inside_and_outside(jammed, kJammed, [](int row, double) { return row >= 3; });
  EXPECT_EQ(found, 7 * kPerRow);
  EXPECT_EQ(wrong, 0);
}

// The probe comes free in the middle of a row; its filter takes a few readings to follow.
TEST(Screened, ARowThatComesFreeIsSetAsideUpToThere) {
  const Scan jammed = scan([](double counts, int row, double y_m) {
    if (row != 2) return counts;
    return counts + (y_m < 0.020 ? 4000.0 : 4000.0 * std::exp(-(y_m - 0.020) / 0.0006));
  });
  const auto [found, wrong] = inside_and_outside(
      jammed, kJammed, [](int row, double y_m) { return row == 2 && y_m < 0.023; });
  EXPECT_GE(found, 100);  // the hundred readings of 20 mm
  EXPECT_EQ(wrong, 0);
}

TEST(Screened, RowsWithoutContactAreSetAside) {
  const Scan lifted = scan([](double counts, int row, double y_m) {
    return row == 9 || (row == 0 && y_m < 0.0051) ? 3360.0 + 1e-3 * (counts - 7000.0) : counts;
  });
  const auto [found, wrong] = inside_and_outside(lifted, kNoContact, [](int row, double y_m) {
    return row == 9 || (row == 0 && y_m < 0.0051);
  });
  EXPECT_EQ(found, kPerRow + 26);
  EXPECT_EQ(wrong, 0);
}

TEST(Screened, ASensorThatHangsIsSetAside) {
  double last = 0.0;
  const Scan hung = scan([&](double counts, int row, double y_m) {
    const bool hangs = row > 8 || (row == 8 && y_m > 0.030);
    return hangs ? last : last = counts;
  });
  const auto [found, wrong] = inside_and_outside(
      hung, kFrozen, [](int row, double y_m) { return row > 8 || (row == 8 && y_m > 0.0297); });
  EXPECT_GE(found, kPerRow + 99);
  EXPECT_EQ(wrong, 0);
}

// Without noise, and written with few digits: its plateau is felt on either side of the tumour.
TEST(Screened, ASensorThatSaysTheSameElsewhereDoesNotHang) {
  const Scan exact =
      scan([](double counts, int, double) { return 1e-3 * std::round(1e3 * counts); }, 0.001, 0.0);
  EXPECT_EQ(found_in(exact), Found{});
  EXPECT_EQ(reasons(live(exact.tissue, exact.palpations)), Found{});
}

// Most of the time; with few digits, so that chance repeats one in three; and at nothing, far
// below.
TEST(Screened, ASensorThatHangsIsSetAsideHoweverItReads) {
  const Surface tissue = sheet();
  const auto found_of = [&](std::size_t first, std::size_t count, double digit, double value) {
    Random random(2);
    std::vector<Palpation> felt;
    for (int i = 0; i < 100; ++i) {
      const Vec3 place(0.030 * random.uniform(), 0.050 * random.uniform(), 0.0);
      const double reading = digit * std::round((counts(place) + 20.0 * random.normal()) / digit);
      felt.push_back({.where = tissue.project(place), .reading = reading});
    }
    for (std::size_t i = first; i < first + count; ++i) felt[i].reading = value;
    return reasons(live(tissue, felt))[kFrozen];
  };
  EXPECT_EQ(found_of(20, 80, 0.01, 7700.0), 80);
  EXPECT_EQ(found_of(40, 25, 30.0, 7025.0), 25);
  EXPECT_EQ(found_of(60, 40, 0.01, 0.0), 40);
  EXPECT_EQ(found_of(0, 0, 30.0, 0.0), 0);
  EXPECT_EQ(found_of(0, 0, 400.0, 0.0), 0);
}

// Tissue of three heights without noise, the first fifty touches by chance on one of them.
TEST(Screened, TissueThatReadsTheSameAtAnyTimeIsNoSensorThatHangs) {
  const Surface tissue = sheet();
  Random random(4);
  std::vector<Palpation> felt;
  for (int i = 0; i < 120; ++i) {
    const Vec3 place((i < 50 ? 0.010 : 0.030) * random.uniform(), 0.050 * random.uniform(), 0.0);
    felt.push_back({.where = tissue.project(place),
                    .reading = place.x() < 0.010   ? 0.5
                               : place.x() < 0.020 ? 1.0
                                                   : 0.0});
  }
  EXPECT_EQ(reasons(live(tissue, felt)), Found{});
}

// Row by row, from the middle of a tumour on, at the greatest of all readings: those of the rows
// beside it are not as high.
TEST(Screened, ASensorThatHangsAtTheEndOfItsRangeIsSetAside) {
  const Surface tissue = sheet();
  const auto found_of = [&](int first, int last) {
    Random random(5);
    std::vector<Palpation> felt;
    for (int i = 0; i < 200; ++i) {
      const int row = i / 10, along = row % 2 == 0 ? i % 10 : 9 - i % 10;
      const Vec3 place(0.0015 + 0.003 * along, 0.00125 + 0.0025 * row, 0.0);
      const double depth_m = 0.007 - (place - Vec3(0.010, 0.025, 0.0)).norm();
      const double reading = 7.0 + 2.0 / (1.0 + std::exp(-1400.0 * depth_m));
      felt.push_back({.where = tissue.project(place),
                      .reading = i >= first && i < last ? 9.2 : reading + 0.05 * random.normal()});
    }
    return reasons(live(tissue, felt))[kFrozen];
  };
  EXPECT_EQ(found_of(104, 113), 9);
  EXPECT_EQ(found_of(0, 0), 0);
}

// As wide as two rows are apart, so that most of the rows beside it feel healthy tissue.
TEST(Screened, ASensorWhoseRangeEndsOnANarrowTumourDoesNotHang) {
  const Surface tissue = sheet();
  for (const double middle_m : {0.020, 0.021, 0.022, 0.023}) {
    Random random(7);
    std::vector<Palpation> felt;
    for (int i = 0; i < 29 * 12; ++i) {
      const int row = i / 29, along = row % 2 == 0 ? i % 29 : 28 - i % 29;
      const Vec3 place(0.001 + 0.001 * along, 0.003 + 0.004 * row, 0.0);
      const double off = std::hypot((place.x() - 0.015) / 0.009, (place.y() - middle_m) / 0.003);
      const double reading = 7.0 + 2.0 / (1.0 + std::exp(-1400.0 * 0.003 * (1.0 - off)));
      felt.push_back({.where = tissue.project(place),
                      .reading = std::min(reading + 0.05 * random.normal(), 8.5)});
    }
    EXPECT_EQ(reasons(live(tissue, felt)), Found{}) << middle_m;
  }
}

// A sensor whose sign or unit changes while one looks; stiff tissue that is touched last, and a
// sensor that was set to nothing on healthy tissue, are none.
TEST(Screened, ReadingsInAnotherUnitAreSetAside) {
  const Surface tissue = sheet();
  using Change = std::function<double(double reading, int i)>;
  const auto found_of = [&](const Change& change) {
    Random random(6);
    std::vector<Palpation> felt;
    for (int i = 0; i < 100; ++i) {
      const Vec3 place(0.0015 + 0.003 * (i % 10), 0.0025 + 0.005 * (i / 10), 0.0);
      const double stiff = (place - Vec3(0.012, 0.025, 0.0)).norm() < 0.008 ? 2.0 : 0.0;
      felt.push_back({.where = tissue.project(place),
                      .reading = change(7.0 + stiff + 0.1 * random.normal(), i)});
    }
    felt[20].reading = 0.0;  // contact that was lost
    return reasons(live(tissue, felt))[kAnotherUnit];
  };
  EXPECT_EQ(found_of([](double reading, int i) { return i < 50 ? reading : -reading; }), 50);
  EXPECT_EQ(found_of([](double reading, int i) { return i < 70 ? reading : -reading; }), 30)
      << "healthy tissue alone";
  EXPECT_EQ(found_of([](double reading, int i) { return i < 50 ? -reading : reading; }), 49)
      << "contact that was lost has no sign";
  EXPECT_EQ(found_of([](double reading, int i) { return i < 70 ? reading : reading - 20.0; }), 0)
      << "a zero that moved";
  EXPECT_EQ(found_of([](double reading, int i) { return i < 20 ? 1e-3 * reading : reading; }), 20);
  EXPECT_EQ(found_of([](double reading, int i) { return i < 70 ? reading : 1e3 * reading; }), 30);
  EXPECT_EQ(found_of([](double reading, int) { return reading; }), 0);
  EXPECT_EQ(found_of([](double reading, int) { return reading - 8.0; }), 0);
  EXPECT_EQ(found_of([](double reading, int i) { return i < 60 ? reading - 7.0 : reading; }), 0);
  EXPECT_EQ(found_of([](double reading, int i) { return i < 60 ? reading : reading - 9.0; }), 0);
}

// Row by row, first what lies at the sensor's lower limit, then a steep tumour.
TEST(Screened, ASensorAtItsLimitDoesNotHang) {
  const Surface tissue = sheet();
  Random random(3);
  std::vector<Palpation> felt;
  for (int i = 0; i < 100; ++i) {
    const Vec3 place(0.0015 + 0.003 * (i % 10), 0.0025 + 0.005 * (i / 10), 0.0);
    felt.push_back(
        {.where = tissue.project(place), .reading = i < 60 ? 1.5 : 5.0 + 0.1 * random.normal()});
  }
  EXPECT_EQ(reasons(live(tissue, felt)), Found{});
}

TEST(Screened, TheStartOfRowsIsSetAsideWhereAllBeginAlike) {
  const Scan waking =
      scan([](double counts, int, double y_m) { return counts - 400.0 * std::exp(-y_m / 0.001); });
  const auto [found, wrong] =
      inside_and_outside(waking, kStartUp, [](int, double y_m) { return y_m <= 0.0030001; });
  EXPECT_EQ(found, 10 * 16);
  EXPECT_EQ(wrong, 0);
}

// Pokes do not start from rest.
TEST(Screened, PokesBesideSuchRowsAreKept) {
  Scan waking =
      scan([](double counts, int, double y_m) { return counts - 400.0 * std::exp(-y_m / 0.001); });
  const std::size_t sliding = waking.palpations.size();
  for (int row = 0; row < 3; ++row) {
    for (double y_m = 0.0; y_m <= 0.050; y_m += 0.0015) {
      const Vec3 place(0.0025 + 0.003 * row, y_m, 0.0);
      waking.palpations.push_back(
          {.where = waking.tissue.project(place), .reading = counts(place)});
    }
  }
  const std::vector<Palpation> result = screened(waking.tissue, waking.palpations);
  EXPECT_EQ(result.front().set_aside, kStartUp);
  for (std::size_t i = sliding; i < result.size(); ++i) EXPECT_EQ(result[i].set_aside, "") << i;
}

TEST(Screened, ARowOnAnotherBaseIsSetAside) {
  const Scan stepped =
      scan([](double counts, int row, double) { return row == 4 ? counts - 1000.0 : counts; });
  const auto [found, wrong] =
      inside_and_outside(stepped, kBaseStep, [](int row, double) { return row == 4; });
  EXPECT_EQ(found, kPerRow);
  EXPECT_EQ(wrong, 0);
}

/// Pokes on a grid, 1.5 mm apart.
std::vector<Palpation> pokes(const Surface& tissue, double noise) {
  std::vector<Palpation> made;
  Random random(2);
  for (int row = 0; row <= 20; ++row) {
    for (int column = 0; column <= 33; ++column) {
      Palpation palpation;
      palpation.where = tissue.project(Vec3(0.0015 * row, 0.0015 * column, 0.0));
      palpation.reading = counts(tissue.position(palpation.where)) + noise * random.normal();
      made.push_back(palpation);
    }
  }
  return made;
}

TEST(Screened, PokesThatContradictTheirNeighboursAreSetAside) {
  const Surface tissue = sheet();
  std::vector<Palpation> grid = pokes(tissue, 75.0);
  EXPECT_EQ(reasons(screened(tissue, grid)), Found{});
  const std::vector<std::size_t> slipped = {100, 101, 102,
                                            400};  // three in a row, and one on the disk's edge
  for (std::size_t i : slipped) grid[i].reading += 3500.0;
  const std::vector<Palpation> result = screened(tissue, grid);
  EXPECT_EQ(reasons(result), (Found{{kOutlier, 4}}));
  for (std::size_t i : slipped) EXPECT_EQ(result[i].set_aside, kOutlier) << i;
}

// Touches 2 mm apart: the farther off the one that failed is, the less it may hide behind itself.
TEST(Screened, AnOutlierFarBeyondTheContrastDoesNotHideBehindItself) {
  const Surface tissue = sheet();
  for (const double far : {3500.0, 5000.0, 20000.0, 1e6, -1e6}) {
    std::vector<Palpation> few;
    Random random(5);
    for (int i = 0; i < 225; ++i) {
      Palpation palpation;
      palpation.where =
          tissue.project(Vec3(0.001 + 0.002 * (i % 15), 0.002 + 0.002 * (i / 15), 0.0));
      palpation.reading =
          counts(tissue.position(palpation.where)) + 75.0 * random.normal() + (i == 18 ? far : 0.0);
      few.push_back(palpation);
    }
    const std::vector<Palpation> result = screened(tissue, few);
    EXPECT_EQ(reasons(result), (Found{{kOutlier, 1}})) << far;
    EXPECT_EQ(result[18].set_aside, kOutlier) << far;
  }
}

// Sixteen touches of healthy tissue and one of a tumour, 8 mm apart: nothing contradicts it.
TEST(Screened, AStiffPlaceThatWasFeltOnceIsKept) {
  const Surface tissue = sheet();
  for (const double noise : {0.0, 1.0, 100.0}) {
    std::vector<Palpation> few;
    Random random(3);
    for (int i = 0; i < 24; ++i) {
      Palpation palpation;
      palpation.where = tissue.project(Vec3(0.003 + 0.008 * (i % 4), 0.004 + 0.008 * (i / 4), 0.0));
      palpation.reading = 7000.0 + noise * random.normal() + (i == 13 ? 1500.0 : 0.0);
      few.push_back(palpation);
    }
    EXPECT_EQ(reasons(screened(tissue, few)), Found{}) << noise;
  }
}

// The last touch within an edge that most others were sent to the far side of; and the same reading
// with healthy tissue all around it, which no edge parts it from.
TEST(Screened, ATouchThatAnEdgePartsFromItsNeighboursIsKept) {
  const Surface tissue = sheet();
  std::vector<Palpation> around;
  const auto felt = [&](double x_mm, double y_mm, double reading) {
    around.push_back(
        {.where = tissue.project(Vec3(0.015 + 0.001 * x_mm, 0.025 + 0.001 * y_mm, 0.0)),
         .reading = reading});
  };
  felt(0.0, 0.0, 1.0);
  felt(-2.8, 1.0, 1.0);
  for (int i = 0; i < 5; ++i) felt(-4.0, 2.0 * i - 4.0, 1.0);
  for (int i = 0; i < 7; ++i) felt(1.0, i - 3.0, 0.0);
  for (int i = 0; i < 7; ++i) felt(2.0, i - 3.0, 0.0);
  EXPECT_EQ(reasons(screened(tissue, around)), Found{});
  for (const double y_mm : {-1.0, 0.0, 1.0}) felt(-1.0, y_mm, 0.0);
  const std::vector<Palpation> result = screened(tissue, around);
  EXPECT_EQ(reasons(result), (Found{{kOutlier, 1}}));
  EXPECT_EQ(result.front().set_aside, kOutlier);
}

// Readings in opposite directions of travel are a lag apart: at the edge they contradict each
// other, and are right.
TEST(Screened, ReadingsOfOppositeTravelAreNotCompared) {
  const Surface tissue = sheet();
  std::vector<Palpation> both;
  Random random(4);
  for (int i = 0; i < 400; ++i) {
    const Vec3 heading = i % 2 == 0 ? Vec3(Vec3::UnitY()) : Vec3(-Vec3::UnitY());
    const Vec3 p(0.030 * random.uniform(), 0.050 * random.uniform(), 0.0);
    Palpation palpation;
    palpation.where = tissue.project(p);
    palpation.reading = counts(p - 0.0015 * heading) + 15.0 * random.normal();
    palpation.travel = heading;
    both.push_back(palpation);
  }
  EXPECT_EQ(reasons(screened(tissue, both)), Found{});
}

TEST(Screened, WhatWasSetAsideBeforeStaysSoAndTellsNothing) {
  const Surface tissue = sheet();
  std::vector<Palpation> grid = pokes(tissue, 75.0);
  for (std::size_t i = 0; i < grid.size(); i += 2) {
    grid[i].reading += 3500.0;
    grid[i].set_aside = "the probe slipped";
  }
  const std::vector<Palpation> once = screened(tissue, grid);
  EXPECT_EQ(reasons(once), (Found{{"the probe slipped", static_cast<int>((grid.size() + 1) / 2)}}));
  EXPECT_EQ(reasons(screened(tissue, once)), reasons(once));
}

TEST(Screened, FewOrConstantReadingsHaveADefinedAnswer) {
  const Surface tissue = sheet();
  EXPECT_TRUE(screened(tissue, {}).empty());
  std::vector<Palpation> grid = pokes(tissue, 0.0);
  EXPECT_EQ(reasons(screened(tissue, std::span(grid).first(1))), Found{});
  EXPECT_EQ(reasons(screened(tissue, std::span(grid).first(2))), Found{});
  for (Palpation& palpation : grid) palpation.reading = 7000.0;
  EXPECT_EQ(reasons(screened(tissue, grid)),
            (Found{{kFrozen, static_cast<int>(grid.size())}}));  // a sensor that is off
  for (Palpation& palpation : grid) palpation.set_aside = "the probe slipped";
  EXPECT_EQ(reasons(screened(tissue, grid)), reasons(grid));
  EXPECT_EQ(reasons(live(tissue, grid)), reasons(grid));
  grid.back().set_aside.clear();
  grid.back().reading = 6900.0;
  EXPECT_EQ(reasons(screened(tissue, grid)), reasons(grid)) << "all but one set aside, and higher";
}

}  // namespace
}  // namespace palpation
