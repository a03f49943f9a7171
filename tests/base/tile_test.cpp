#include "base/tile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "palpation/base/random.h"

namespace palpation {
namespace {

/// By how many units in the last place of the nearest double a value is off.
double units_off(double value, long double exact) {
  const double nearest = static_cast<double>(exact);
  const double unit = std::nextafter(nearest, std::numeric_limits<double>::infinity()) - nearest;
  return static_cast<double>(std::abs(static_cast<long double>(value) - exact)) / unit;
}

TEST(Exponentials, AreRightToTwoUnitsOverTheWholeRange) {
  std::vector<double> arguments;
  for (double x = -745.1; x < 709.7; x += 0.00917) arguments.push_back(x);
  for (double x = 1.0; x > 1e-300; x *= 0.37) arguments.insert(arguments.end(), {x, -x});
  arguments.resize(arguments.size() / kLanes * kLanes);
  std::vector<double> values = arguments;
  exponentials(values.data(), static_cast<long>(values.size()));
  double worst = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
    worst = std::max(worst, units_off(values[i], std::exp(static_cast<long double>(arguments[i]))));
  EXPECT_LT(worst, 2.0);
}

TEST(Exponentials, KnowTheEndsOfTheRange) {
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> values = {0.0,          -0.0,   -infinity, infinity,
                                std::nan(""), -1e300, 710.5,     -745.2};
  exponentials(values.data(), kLanes);
  EXPECT_EQ(values[0], 1.0);
  EXPECT_EQ(values[1], 1.0);
  EXPECT_EQ(values[2], 0.0);
  EXPECT_EQ(values[3], infinity);
  EXPECT_TRUE(std::isnan(values[4]));
  EXPECT_EQ(values[5], 0.0);
  EXPECT_EQ(values[6], infinity);
  EXPECT_EQ(values[7], 0.0);
}

std::vector<double> random_values(std::size_t count, Random& random) {
  std::vector<double> values(count);
  for (double& value : values) value = random.normal();
  return values;
}

TEST(SubtractStrips, IsTheTripleLoop) {
  Random random(1);
  for (int rows = 1; rows <= panel_rows(); ++rows) {
    // Two stretches of known rows, of two tiles each, then the triangle.
    const std::vector<double> a = random_values(2 * 7 * kLanes, random),
                              b = random_values(2 * 13 * kLanes, random);
    const TileRows known[] = {{a.data(), 7 * kLanes, 7}, {b.data(), 13 * kLanes, 13}};
    const int stride = 20 + rows + 3;
    const std::vector<double> factor =
        random_values(static_cast<std::size_t>(rows * stride), random);
    const std::vector<double> pivots = random_values(static_cast<std::size_t>(rows), random);
    const std::vector<double> start =
        random_values(static_cast<std::size_t>(rows) * kLanes, random);
    for (const int tile : {0, 1}) {
      for (const bool solved : {false, true}) {
        std::vector<double> fresh = start;
        subtract_strips({factor.data(), stride, rows, solved ? pivots.data() : nullptr}, known, 2,
                        tile, fresh.data());
        std::vector<double> slow = start;
        for (int r = 0; r < rows; ++r) {
          for (int lane = 0; lane < kLanes; ++lane) {
            double& value = slow[r * kLanes + lane];
            for (int i = 0; i < 7; ++i)
              value -= factor[r * stride + i] * a[(tile * 7 + i) * kLanes + lane];
            for (int i = 0; i < 13; ++i)
              value -= factor[r * stride + 7 + i] * b[(tile * 13 + i) * kLanes + lane];
            for (int i = 0; solved && i < r; ++i)
              value -= factor[r * stride + 20 + i] * slow[i * kLanes + lane];
            if (solved) value *= pivots[r];
          }
        }
        // Random triangles grow errors with their values.
        for (std::size_t i = 0; i < slow.size(); ++i)
          EXPECT_NEAR(fresh[i], slow[i], 1e-10 * (1.0 + std::abs(slow[i]))) << rows << " rows";
      }
    }
  }
}

TEST(SubtractPacked, IsSubtractStripsToTheBitOnAnyNumberOfTiles) {
  Random random(4);
  constexpr int kTiles = 5, kDepths[] = {7, 13};
  const std::vector<double> a = random_values(kTiles * 7 * kLanes, random),
                            b = random_values(kTiles * 13 * kLanes, random);
  std::vector<float> singles(b.begin(), b.end());
  const TileRows doubles[] = {{a.data(), 7 * kLanes, 7}, {b.data(), 13 * kLanes, 13}};
  const TileRows mixed[] = {{a.data(), 7 * kLanes, 7}, {nullptr, 13 * kLanes, 13, singles.data()}};
  for (int rows = 1; rows <= 2 * panel_rows() + 1; ++rows) {
    const int columns = kDepths[0] + kDepths[1] + rows;
    const std::vector<double> factor =
        random_values(static_cast<std::size_t>(rows * columns), random);
    const PackedFactor packed(factor.data(), columns, rows, columns);
    const long per_tile = rows * kLanes;
    const std::vector<double> start =
        random_values(static_cast<std::size_t>(kTiles * per_tile), random);
    for (const TileRows* known : {doubles, mixed}) {
      for (int row = 0; row < rows; row += packed.height()) {
        // Up to its own triangle a panel's columns are strips too: here of zeros.
        const std::vector<double> zeros(static_cast<std::size_t>(kTiles * (row + 1)) * kLanes);
        const TileRows strips[] = {known[0], known[1], {zeros.data(), row * kLanes, row}};
        std::vector<double> fast = start, slow = start;
        const PackedPanel panel = packed.panel(row, 0, true);
        subtract_packed(panel, strips, 3, 1, kTiles - 1, fast.data() + per_tile + row * kLanes,
                        per_tile);
        std::vector<double> pivots;
        for (int r = row; r < row + panel.rows; ++r)
          pivots.push_back(1.0 / factor[r * columns + 20 + r]);
        for (int tile = 1; tile < kTiles; ++tile) {
          subtract_strips({factor.data() + row * columns, columns, panel.rows, pivots.data()},
                          strips, 3, tile, slow.data() + tile * per_tile + row * kLanes);
        }
        EXPECT_EQ(fast, slow) << rows << " rows from " << row;
      }
    }
  }
}

TEST(SubtractProduct, TakesAsManyRowsAsThereAre) {
  Random random(2);
  constexpr int kRows = 31, kDepth = 17;
  const std::vector<double> factor = random_values(kRows * kDepth, random),
                            tile = random_values(kDepth * kLanes, random);
  std::vector<double> fresh(kRows * kLanes, 0.0);
  subtract_product(factor.data(), kDepth, tile.data(), kDepth, fresh.data(), kRows);
  for (int r = 0; r < kRows; ++r) {
    for (int lane = 0; lane < kLanes; ++lane) {
      double slow = 0.0;
      for (int i = 0; i < kDepth; ++i) slow -= factor[r * kDepth + i] * tile[i * kLanes + lane];
      EXPECT_NEAR(fresh[r * kLanes + lane], slow, 1e-13);
    }
  }
}

TEST(AddSums, AddsSquaresAndEveryWeightedSum) {
  Random random(3);
  constexpr int kRows = 23;
  const std::vector<double> values = random_values(kRows * kLanes, random),
                            weights = random_values(kRows * kMostWeights, random);
  for (int count = 0; count <= kMostWeights; ++count) {
    std::vector<double> sums((1 + kMostWeights) * kLanes, 1.0);
    add_sums(values.data(), kRows, weights.data(), kRows, count, sums.data());
    for (int lane = 0; lane < kLanes; ++lane) {
      double squares = 1.0;
      for (int r = 0; r < kRows; ++r)
        squares += values[r * kLanes + lane] * values[r * kLanes + lane];
      EXPECT_NEAR(sums[lane], squares, 1e-13);
      for (int j = 0; j < kMostWeights; ++j) {
        double sum = 1.0;
        for (int r = 0; r < kRows && j < count; ++r)
          sum += weights[j * kRows + r] * values[r * kLanes + lane];
        EXPECT_NEAR(sums[(1 + j) * kLanes + lane], sum, 1e-13);
      }
    }
  }
}

}  // namespace
}  // namespace palpation
