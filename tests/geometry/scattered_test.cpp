#include "palpation/geometry/scattered.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include "geometry/zoo.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kAnywhere = std::numeric_limits<double>::infinity();

Points2 random_points(int count, std::uint64_t seed) {
  Random random(seed);
  Points2 points(count, 2);
  for (double& coordinate : points.reshaped()) coordinate = random.uniform();
  return points;
}

Points2 grid_points(int side) { return zoo::unit_square_mesh(side).vertices.leftCols<2>(); }

TEST(ScatteredField, ReproducesLinearFunctions) {
  for (const Points2& points : {random_points(200, 1), grid_points(10)}) {
    const ScatteredField field(points, (points * Vec2(2.0, -3.0)).array() + 5.0);
    Random random(2);
    int inside = 0;
    for (int k = 0; k < 500; ++k) {
      const Vec2 place(random.uniform(), random.uniform());
      const std::optional<double> value = field.at(place, kAnywhere);
      if (!value) continue;
      ++inside;
      EXPECT_NEAR(*value, 2.0 * place.x() - 3.0 * place.y() + 5.0,
                  1e-12);  // rounding, grown by slivers at the hull
    }
    EXPECT_GT(inside, 450);
  }
}

TEST(ScatteredField, GivesTheValuesBackAtThePoints) {
  const Points2 points = random_points(100, 3);
  Eigen::VectorXd values(100);
  for (int i = 0; i < 100; ++i) values[i] = std::sin(10.0 * i);
  const ScatteredField field(points, values);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(field.at(points.row(i), 0.0), values[i]);
}

TEST(ScatteredField, SaysNothingOutsideTheHullOrOutOfReach) {
  Points2 corners(4, 2);
  corners << 0, 0, 1, 0, 0, 1, 1, 1;
  const ScatteredField field(corners, Eigen::Vector4d(1.0, 2.0, 3.0, 4.0));
  EXPECT_FALSE(field.at(Vec2(1.001, 0.5), kAnywhere));
  EXPECT_FALSE(field.at(Vec2(-1e-9, 0.5), kAnywhere));
  EXPECT_TRUE(field.at(Vec2(0.5, 0.5), 0.71));  // the middle is 0.7071 from every corner
  EXPECT_FALSE(field.at(Vec2(0.5, 0.5), 0.70));
  EXPECT_TRUE(field.at(Vec2(0.5, 0.0), 0.5));  // on the hull
  EXPECT_FALSE(field.at(Vec2(0.5, 0.0), 0.49));
}

TEST(ScatteredField, MeasuresReachToTheNearestPointEvenIfThatIsNoCornerOfTheTriangle) {
  const Points2 points = random_points(300, 4);
  const ScatteredField field(points, Eigen::VectorXd::Ones(300));
  Random random(5);
  for (int k = 0; k < 500; ++k) {
    const Vec2 place(random.uniform(), random.uniform());
    if (!field.at(place, kAnywhere)) continue;
    const double nearest = (points.rowwise() - place.transpose()).rowwise().norm().minCoeff();
    EXPECT_TRUE(field.at(place, 1.000001 * nearest));
    EXPECT_FALSE(field.at(place, 0.999999 * nearest));
  }
}

TEST(ScatteredField, AveragesValuesOfOnePlace) {
  Points2 points(5, 2);
  points << 0, 0, 1, 0, 0, 1, 1, 0, 1, 0;
  Eigen::VectorXd values(5);
  values << 0.0, 1.0, 0.0, 2.0, 6.0;
  const ScatteredField field(points, values);
  EXPECT_DOUBLE_EQ(*field.at(Vec2(1.0, 0.0), 0.0), 3.0);
  EXPECT_DOUBLE_EQ(*field.at(Vec2(0.5, 0.0), 1.0), 1.5);
}

TEST(ScatteredField, DoesNotDependOnTheOrderOfThePointsEvenOnAGrid) {
  // Four points of a grid cell are on one circle: either diagonal is Delaunay.
  const Points2 points = grid_points(12);
  Eigen::VectorXd values(points.rows());
  for (Eigen::Index i = 0; i < values.size(); ++i)
    values[i] = std::cos(3.0 * static_cast<double>(i));
  Random random(6);
  const std::vector<int> order = zoo::shuffled(static_cast<int>(points.rows()), random);
  const ScatteredField field(points, values), other(points(order, Eigen::all), values(order));
  for (int k = 0; k < 500; ++k) {
    const Vec2 place(random.uniform(), random.uniform());
    EXPECT_EQ(field.at(place, 1.0), other.at(place, 1.0));
  }
}

TEST(ScatteredField, GivesTheSameValuesInEveryThread) {
  const Points2 points = random_points(500, 7), places = random_points(4000, 8);
  const ScatteredField field(points, points.col(0).array().square());
  const auto evaluate = [&](std::vector<double>& values) {
    for (const auto& place : places.rowwise())
      values.push_back(field.at(place, 1.0).value_or(-1.0));
  };
  std::vector<double> alone;
  evaluate(alone);
  std::vector<std::vector<double>> together(4);
  {
    std::vector<std::jthread> threads;
    for (std::vector<double>& values : together) threads.emplace_back([&] { evaluate(values); });
  }
  for (const std::vector<double>& values : together) EXPECT_EQ(values, alone);
}

TEST(ScatteredField, RefusesPointsThatSpanNoTriangle) {
  Points2 line(3, 2);
  line << 0, 0, 1, 1, 2, 2;
  EXPECT_THROW(ScatteredField(line, Eigen::Vector3d::Zero()), InvalidInput);
  EXPECT_THROW(ScatteredField(Points2(0, 2), Eigen::VectorXd()), InvalidInput);
  EXPECT_THROW(ScatteredField(Points2::Zero(3, 2), Eigen::Vector3d::Zero()), InvalidInput);
}

TEST(ScatteredField, RefusesSizesThatDisagreeAndNumbersThatAreNone) {
  Points2 points = random_points(5, 9);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(5);
  EXPECT_THROW(ScatteredField(points, Eigen::VectorXd::Zero(4)), InvalidInput);
  const ScatteredField field(points, values);
  EXPECT_THROW(field.at(Vec2(0.0, std::numeric_limits<double>::quiet_NaN()), 1.0), InvalidInput);
  EXPECT_THROW(field.at(Vec2(0.0, 0.0), -1.0), InvalidInput);
  values[3] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(ScatteredField(points, values), InvalidInput);
  values[3] = 0.0;
  points(2, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ScatteredField(points, values), InvalidInput);
}

}  // namespace
}  // namespace palpation
