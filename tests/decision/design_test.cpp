#include "palpation/decision/design.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "decision/tissue.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

std::vector<int> design_of(const Surface& surface, Design design, int count,
                           std::uint64_t seed = 1) {
  Random random(seed);
  return initial_design(surface, design, count, all_vertices(surface), random);
}

/// Places in tenths of millimetres, so that they compare exactly.
std::set<std::pair<int, int>> places_of(const Surface& surface, const std::vector<int>& vertices) {
  std::set<std::pair<int, int>> places;
  for (const int vertex : vertices) {
    const Vec3 p = surface.vertex(vertex);
    places.emplace(static_cast<int>(std::lround(1e4 * p.x())),
                   static_cast<int>(std::lround(1e4 * p.y())));
  }
  return places;
}

std::set<std::pair<int, int>> product(const std::vector<int>& x, const std::vector<int>& y) {
  std::set<std::pair<int, int>> places;
  for (const int u : x) {
    for (const int v : y) places.emplace(u, v);
  }
  return places;
}

// Cells of 2 x 2 mm on 8 x 8 mm, centres at 1, 3, 5, 7 mm, where there are vertices.
TEST(InitialDesign, GridOfSixteenOnASquareIsFourByFour) {
  const Surface square = sheet(0.008, 0.008, 0.001);
  EXPECT_EQ(places_of(square, design_of(square, Design::Grid, 16)),
            product({10, 30, 50, 70}, {10, 30, 50, 70}));
}

// 4 x 4 cells of 6.25 x 12.5 mm and 2 x 8 cells of 12.5 x 6.25 mm are equally far from square: the
// grid nearer to a square one counts.
TEST(InitialDesign, GridOfSixteenOnTheTallPhantomIsFourByFour) {
  const Surface phantom = sheet(0.025, 0.050, 0.003125);
  const std::set<std::pair<int, int>> places =
      places_of(phantom, design_of(phantom, Design::Grid, 16));
  EXPECT_EQ(places, product({31, 94, 156, 219},
                            {63, 188, 313, 438}));  // 3.125, 9.375, ... and 6.25, 18.75, ... mm
}

// 2 x 5 cells of 12.5 x 10 mm on 25 x 50 mm.
TEST(InitialDesign, GridTakesTheFactorsThatMakeCellsMostNearlySquare) {
  const Surface phantom = sheet(0.025, 0.050, 0.00125);
  EXPECT_EQ(places_of(phantom, design_of(phantom, Design::Grid, 10)),
            product({63, 188}, {50, 150, 250, 350, 450}));
}

// Seven in one row would be seven times as long as wide; the next grid, of 2 x 4 or 4 x 2 cells,
// has one cell too many.
TEST(InitialDesign, GridOfAPrimeCountDropsCellsOfTheNextLargerGrid) {
  const Surface square = sheet(0.008, 0.008, 0.001);
  std::set<std::pair<int, int>> eight = places_of(square, design_of(square, Design::Grid, 8));
  const std::set<std::pair<int, int>> seven = places_of(square, design_of(square, Design::Grid, 7));
  ASSERT_EQ(eight.size(), 8u);
  EXPECT_EQ(seven.size(), 7u);
  EXPECT_TRUE(std::includes(eight.begin(), eight.end(), seven.begin(), seven.end()));
}

// A strip 100 times as long as wide: four cells in one row, as there is nothing better.
TEST(InitialDesign, GridOnANarrowStripIsOneRow) {
  const Surface strip = sheet(0.1, 0.001, 0.0005);
  EXPECT_EQ(places_of(strip, design_of(strip, Design::Grid, 4)),
            product({125, 375, 625, 875}, {5}));
}

// Three quarters of a square of 8 mm: of 4 x 4 cells twelve have their centre on the tissue.
TEST(InitialDesign, GridOnTissueThatDoesNotFillItsBoxGetsFinerUntilEnoughCellsAreOnIt) {
  const Surface shape = l_shape(0.008, 8);
  std::set<std::pair<int, int>> expected = product({10, 30, 50, 70}, {10, 30});
  expected.merge(product({10, 30}, {50, 70}));
  EXPECT_EQ(places_of(shape, design_of(shape, Design::Grid, 12)), expected);
}

TEST(InitialDesign, ReturnsAsManyDistinctVerticesAsAskedForInIncreasingOrder) {
  const Surface coarse = sheet(0.003, 0.003, 0.001);  // 16 vertices
  const Surface shape = l_shape(0.010, 10);
  for (const Surface& surface : {coarse, shape}) {
    for (const Design design : {Design::Random, Design::Grid, Design::LowDiscrepancy}) {
      for (const int count : {0, 1, 2, 3, 5, 11, 15}) {
        const std::vector<int> vertices = design_of(surface, design, count);
        EXPECT_EQ(vertices.size(), static_cast<std::size_t>(count));
        EXPECT_TRUE(std::is_sorted(vertices.begin(), vertices.end(),
                                   std::less_equal<>()));  // less_equal: no vertex twice
      }
    }
  }
}

TEST(InitialDesign, TakesAllCandidatesIfThereAreNoMoreThanAskedFor) {
  const Surface square = sheet(0.003, 0.003, 0.001);
  const std::vector<int> candidates = {9, 3, 7, 3};
  for (const Design design : {Design::Random, Design::Grid, Design::LowDiscrepancy}) {
    Random random(1);
    EXPECT_EQ(initial_design(square, design, 3, candidates, random), (std::vector<int>{3, 7, 9}));
    EXPECT_TRUE(initial_design(square, design, 3, std::vector<int>{}, random).empty());
  }
}

TEST(InitialDesign, TouchesCandidatesOnly) {
  const Surface square = sheet(0.010, 0.010, 0.001);
  std::vector<int> even;
  for (int vertex = 0; vertex < square.vertex_count(); vertex += 2) even.push_back(vertex);
  for (const Design design : {Design::Random, Design::Grid, Design::LowDiscrepancy}) {
    Random random(1);
    for (const int vertex : initial_design(square, design, 20, even, random))
      EXPECT_EQ(vertex % 2, 0);
  }
}

// One vertex of nine, 4,500 times. A share p has a standard deviation of sqrt(p (1 - p) / 4500);
// nine shares within 4.5 of it: 1 in 16,000 by chance.
TEST(InitialDesign, RandomFollowsTheAreaOfTheTissueAroundTheVertices) {
  const Surface square = sheet(0.002, 0.002, 0.001);
  const std::vector<int> candidates = all_vertices(square);
  Random random(7);
  std::array<int, 9> hits{};
  for (int trial = 0; trial < 4500; ++trial)
    ++hits[initial_design(square, Design::Random, 1, candidates, random).front()];
  for (int vertex = 0; vertex < 9; ++vertex) {
    const double share = square.vertex_areas()[vertex] / square.area();
    EXPECT_NEAR(hits[vertex] / 4500.0, share, 4.5 * std::sqrt(share * (1.0 - share) / 4500.0))
        << "vertex " << vertex;
  }
}

// 64 points in 16 equal squares: four each, give or take two; independent points would do that in
// one design of a few hundred.
TEST(InitialDesign, LowDiscrepancyFillsTheTissueEvenly) {
  const Surface square = sheet(0.040, 0.040, 0.0005);
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    std::array<int, 16> hits{};
    for (const int vertex : design_of(square, Design::LowDiscrepancy, 64, seed)) {
      const Vec3 p = square.vertex(vertex);
      const auto part = [](double coordinate_m) {
        return std::min(3, static_cast<int>(coordinate_m / 0.010));
      };
      ++hits[4 * part(p.y()) + part(p.x())];
    }
    for (const int count : hits) EXPECT_NEAR(count, 4, 2) << "seed " << seed;
  }
}

TEST(InitialDesign, IsDecidedByTheSeedWhereItIsRandomAndByNothingWhereItIsAGrid) {
  const Surface square = sheet(0.020, 0.020, 0.001);
  for (const Design design : {Design::Random, Design::LowDiscrepancy}) {
    EXPECT_EQ(design_of(square, design, 10, 1), design_of(square, design, 10, 1));
    EXPECT_NE(design_of(square, design, 10, 1), design_of(square, design, 10, 2));
  }
  EXPECT_EQ(design_of(square, Design::Grid, 10, 1), design_of(square, Design::Grid, 10, 2));
}

TEST(InitialDesign, RefusesNegativeCountsAndCandidatesThatAreNoVertices) {
  const Surface square = sheet(0.002, 0.002, 0.001);
  Random random(1);
  EXPECT_THROW(initial_design(square, Design::Random, -1, all_vertices(square), random),
               InvalidInput);
  for (const int bad : {-1, 9})
    EXPECT_THROW(initial_design(square, Design::Random, 1, std::vector<int>{0, bad}, random),
                 InvalidInput);
}

}  // namespace
}  // namespace palpation
