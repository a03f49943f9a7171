#include "exploration/parallel_planes.h"

#include <gtest/gtest.h>

#include "palpation/base/random.h"

namespace palpation {
namespace {

constexpr double kNoise = 0.05;
constexpr double kNeeded = 8.0;

struct Felt {
  Eigen::MatrixX2d places;
  Eigen::VectorXd values;
};

/// At random places of tissue of 0.04 x 0.05 m, a share of which reads 2 more.
Felt felt(double high_share, const Eigen::Vector2d& slope, std::uint64_t seed, int count = 120) {
  Random random(seed);
  Felt made{Eigen::MatrixX2d(count, 2), Eigen::VectorXd(count)};
  for (int i = 0; i < count; ++i) {
    made.places.row(i) << 0.04 * random.uniform(), 0.05 * random.uniform();
    const double stiff = made.places(i, 0) < 0.04 * high_share ? 2.0 : 0.0;
    made.values[i] = 7.0 + stiff + made.places.row(i).dot(slope) + kNoise * random.normal();
  }
  return made;
}

TEST(ParallelPlanes, AreFoundHoweverMuchEachOfThemHolds) {
  for (const double share : {0.1, 0.5, 0.8}) {
    for (const Eigen::Vector2d& slope :
         {Eigen::Vector2d(60.0, 20.0), Eigen::Vector2d(-100.0, 40.0)}) {
      const auto [places, values] = felt(share, slope, 1);
      const std::vector<Eigen::Vector2d> found =
          slopes_of_parallel_planes(places, values, kNeeded, 1);
      ASSERT_EQ(found.size(), 1u) << share;
      // Of the noise over the places' spread, the slope's standard deviation is 1 per metre.
      EXPECT_LT((found.front() - slope).norm(), 4.0) << share;
    }
  }
}

TEST(ParallelPlanes, AreNoneWhereLevelOnesExplainAsMuch) {
  for (const double share : {0.0, 0.2, 0.5}) {
    const auto [places, values] = felt(share, Eigen::Vector2d::Zero(), 2);
    EXPECT_TRUE(slopes_of_parallel_planes(places, values, kNeeded, 3).empty()) << share;
  }
}

TEST(ParallelPlanes, FollowUnitsOfPlacesAndReadings) {
  const auto [places, values] = felt(0.3, {60.0, 20.0}, 3);
  const std::vector<Eigen::Vector2d> here = slopes_of_parallel_planes(places, values, kNeeded, 1),
                                     there = slopes_of_parallel_planes(1e3 * places, 1e-6 * values,
                                                                       kNeeded, 1);
  ASSERT_EQ(here.size(), 1u);
  ASSERT_EQ(there.size(), 1u);
  EXPECT_LT((there.front() - 1e-9 * here.front()).norm(), 1e-15);
}

TEST(ParallelPlanes, AreTheSameInWhateverOrderReadingsCome) {
  const auto [places, values] = felt(0.3, {60.0, 20.0}, 3, 1000);
  const std::vector<Eigen::Vector2d> here = slopes_of_parallel_planes(places, values, kNeeded, 1),
                                     there = slopes_of_parallel_planes(
                                         places.colwise().reverse(), values.reverse(), kNeeded, 1);
  ASSERT_EQ(here.size(), 1u);
  ASSERT_EQ(there.size(), 1u);
  EXPECT_EQ(here.front(), there.front());
}

TEST(ParallelPlanes, AreNotAskedOfFewReadingsNorOfLikeOnes) {
  const auto [places, values] = felt(0.3, {60.0, 20.0}, 3, 9);
  EXPECT_TRUE(slopes_of_parallel_planes(places, values, kNeeded, 1).empty());
  const Felt alike{Eigen::MatrixX2d::Random(50, 2), Eigen::VectorXd::Constant(50, 7.0)};
  EXPECT_TRUE(slopes_of_parallel_planes(alike.places, alike.values, kNeeded, 1).empty());
  const Felt on_a_line{Eigen::MatrixX2d::Zero(50, 2), Eigen::VectorXd::Random(50)};
  EXPECT_TRUE(slopes_of_parallel_planes(on_a_line.places, on_a_line.values, kNeeded, 1).empty());
}

}  // namespace
}  // namespace palpation
