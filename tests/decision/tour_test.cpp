#include "palpation/decision/tour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "palpation/base/error.h"
#include "palpation/base/random.h"
#include "palpation/base/types.h"

namespace palpation {
namespace {

Eigen::MatrixXd distances_between(const std::vector<Vec2>& places) {
  const auto count = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd distance(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) distance(i, j) = (places[i] - places[j]).norm();
  }
  return distance;
}

std::vector<Vec2> random_places(int count, Random& random) {
  std::vector<Vec2> places;
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform();
    places.emplace_back(x, random.uniform());
  }
  return places;
}

std::vector<int> identity(int count) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  return order;
}

double shortest_of_all_orders(const Eigen::MatrixXd& distance) {
  std::vector<int> order = identity(static_cast<int>(distance.rows()) - 1);
  double shortest = std::numeric_limits<double>::infinity();
  do {
    shortest = std::min(shortest, tour_length(distance, order));
  } while (std::next_permutation(order.begin(), order.end()));
  return shortest;
}

std::vector<int> nearest_neighbour_order(const Eigen::MatrixXd& distance) {
  std::vector<int> order, left = identity(static_cast<int>(distance.rows()) - 1);
  int place = 0;
  while (!left.empty()) {
    const auto next = std::min_element(left.begin(), left.end(), [&](int a, int b) {
      return distance(place, a + 1) < distance(place, b + 1);
    });
    place = *next + 1;
    order.push_back(*next);
    left.erase(next);
  }
  return order;
}

bool is_permutation_of_stops(std::vector<int> order, int count) {
  std::sort(order.begin(), order.end());
  return order == identity(count);
}

// The probe is at 0, the stops at 3, 1 and 2 on a line: one sweep, 3 long.
TEST(ShortestTour, SweepsALineOnceFromWhereTheProbeIs) {
  const Eigen::MatrixXd distance = distances_between({{0, 0}, {3, 0}, {1, 0}, {2, 0}});
  const std::vector<int> order = shortest_tour(distance);
  EXPECT_EQ(order, (std::vector<int>{1, 2, 0}));
  EXPECT_EQ(tour_length(distance, order), 3.0);
}

// Stops at -1 and 1.5, 4: the nearest first and then to the other side costs 1 + 5 = 6; the path is
// open, so there is no way back to pay.
TEST(ShortestTour, IsAnOpenPath) {
  const Eigen::MatrixXd distance = distances_between({{0, 0}, {4, 0}, {-1, 0}, {1.5, 0}});
  EXPECT_EQ(shortest_tour(distance), (std::vector<int>{1, 2, 0}));
  EXPECT_EQ(tour_length(distance, shortest_tour(distance)), 6.0);
}

TEST(ShortestTour, OfNoStopIsEmptyAndOfOneStopIsThatStop) {
  EXPECT_TRUE(shortest_tour(Eigen::MatrixXd::Zero(1, 1)).empty());
  EXPECT_EQ(shortest_tour(distances_between({{0, 0}, {1, 0}})), std::vector<int>{0});
}

TEST(ShortestTour, IsAsShortAsTheBestOfAllOrdersOfEightStops) {
  Random random(1);
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::MatrixXd distance = distances_between(random_places(9, random));
    const std::vector<int> order = shortest_tour(distance);
    ASSERT_TRUE(is_permutation_of_stops(order, 8));
    EXPECT_NEAR(tour_length(distance, order), shortest_of_all_orders(distance),
                1e-14);  // sums of 8 numbers below 2
  }
}

TEST(ShortestTour, IsAsShortAsTheBestOfAllOrdersOfNineStopsWithoutTheTriangleInequality) {
  Random random(2);
  Eigen::MatrixXd distance = Eigen::MatrixXd::Zero(10, 10);
  for (int i = 0; i < 10; ++i) {
    for (int j = 0; j < i; ++j) distance(i, j) = distance(j, i) = random.uniform();
  }
  EXPECT_NEAR(tour_length(distance, shortest_tour(distance)), shortest_of_all_orders(distance),
              1e-14);  // sums of 9 numbers below 1
}

// All stops are one place: every order is as long as any other.
TEST(ShortestTour, OfEqualsTakesTheLowerIndexFirst) {
  for (const int stops : {5, 12, 20}) {
    std::vector<Vec2> places(stops + 1, Vec2(1, 0));
    places[0] = Vec2(0, 0);
    EXPECT_EQ(shortest_tour(distances_between(places)), identity(stops)) << stops << " stops";
  }
}

// Twenty stops around half a circle of radius 1: the best path walks the arc, 19 chords and the
// step from the probe at its first end.
TEST(ShortestTour, WalksAnArcOfTwentyStopsFromOneEndToTheOther) {
  std::vector<Vec2> places = {{1.1, 0.0}};
  for (int i = 0; i < 20; ++i) {
    const double angle = 3.14159265358979323846 * (i * 7 % 20) / 19.0;
    places.emplace_back(std::cos(angle), std::sin(angle));
  }
  const Eigen::MatrixXd distance = distances_between(places);
  const double arc = 0.1 + 19.0 * 2.0 * std::sin(3.14159265358979323846 / 38.0);
  EXPECT_NEAR(tour_length(distance, shortest_tour(distance)), arc, 1e-13);  // rounding of 20 terms
}

TEST(ShortestTour, IsNeverLongerThanNearestNeighbour) {
  Random random(3);
  for (int trial = 0; trial < 60; ++trial) {
    const int stops = 1 + trial;
    const Eigen::MatrixXd distance = distances_between(random_places(stops + 1, random));
    const std::vector<int> order = shortest_tour(distance);
    ASSERT_TRUE(is_permutation_of_stops(order, stops));
    EXPECT_LE(tour_length(distance, order),
              tour_length(distance, nearest_neighbour_order(distance)) + 1e-12)
        << stops << " stops";
  }
}

// Beyond the exact range no reversal of a stretch and no move of one, two or three neighbours is
// left that would help.
TEST(ShortestTour, LeavesNoReversalAndNoMoveThatHelps) {
  Random random(4);
  const int stops = 25;
  const Eigen::MatrixXd distance = distances_between(random_places(stops + 1, random));
  const std::vector<int> order = shortest_tour(distance);
  const double length = tour_length(distance, order);
  for (int first = 0; first < stops; ++first) {
    for (int end = first + 1; end < stops; ++end) {
      std::vector<int> other = order;
      std::reverse(other.begin() + first, other.begin() + end + 1);
      EXPECT_GE(tour_length(distance, other),
                length - 1e-11);  // a gain below 1e-12 of the longest distance is not taken
    }
  }
  for (int first = 0; first < stops; ++first) {
    for (int size = 1; size <= 3 && first + size <= stops; ++size) {
      for (int behind = 0; behind + size <= stops; ++behind) {
        std::vector<int> stretch(order.begin() + first, order.begin() + first + size),
            other = order;
        other.erase(other.begin() + first, other.begin() + first + size);
        other.insert(other.begin() + behind, stretch.begin(), stretch.end());
        EXPECT_GE(tour_length(distance, other), length - 1e-11);
      }
    }
  }
}

TEST(ShortestTour, RefusesWhatIsNoTableOfDistances) {
  const Eigen::MatrixXd good = distances_between({{0, 0}, {1, 0}, {2, 0}});
  EXPECT_THROW(shortest_tour(Eigen::MatrixXd(0, 0)), InvalidInput);
  EXPECT_THROW(shortest_tour(Eigen::MatrixXd::Zero(2, 3)), InvalidInput);
  for (const double bad :
       {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    Eigen::MatrixXd distance = good;
    distance(1, 2) = distance(2, 1) = bad;
    EXPECT_THROW(shortest_tour(distance), InvalidInput) << bad;
  }
  Eigen::MatrixXd skew = good;
  skew(1, 2) = 1.001;
  EXPECT_THROW(shortest_tour(skew), InvalidInput);
  EXPECT_THROW(tour_length(good, {0, 2}), InvalidInput);
}

}  // namespace
}  // namespace palpation
