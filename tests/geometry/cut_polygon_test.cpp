#include "geometry/cut_polygon.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "palpation/base/random.h"

namespace palpation {
namespace {

using Polygon = std::vector<Vec3>;

/// Twice the area vectors of the triangles, and the sum of their lengths.
std::pair<Vec3, double> areas(const Polygon& polygon) {
  Vec3 sum = Vec3::Zero();
  double lengths = 0.0;
  for (const auto& [a, b, c] : cut_polygon(polygon)) {
    const Vec3 area = (polygon[b] - polygon[a]).cross(polygon[c] - polygon[a]);
    sum += area;
    lengths += area.norm();
  }
  return {sum, lengths};
}

// A comb of two teeth: seen from no corner as a whole. Area 3 x 3 less the gap of 1 x 2.
const Polygon kComb = {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0},
                       {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};

TEST(CutPolygon, CoversWhatNoCornerSeesAsAWhole) {
  EXPECT_EQ(cut_polygon(kComb).size(), 6u);
  const auto [sum, lengths] = areas(kComb);
  EXPECT_EQ(sum, Vec3(0.0, 0.0, 14.0));
  EXPECT_EQ(lengths, 14.0);  // none overlaps: all turn alike, and their areas add up
}

TEST(CutPolygon, TurnsAsThePolygonDoes) {
  Polygon clockwise = kComb;
  std::reverse(clockwise.begin(), clockwise.end());
  EXPECT_EQ(areas(clockwise).first, Vec3(0.0, 0.0, -14.0));
  for (Vec3& corner : clockwise) corner = Vec3(corner.y(), corner.z(), corner.x());
  EXPECT_EQ(areas(clockwise).first, Vec3(0.0, -14.0, 0.0));
}

TEST(CutPolygon, KeepsTheAreaVectorOfWhatIsNotFlat) {
  Random random(1);
  Polygon bent = kComb;
  for (Vec3& corner : bent) corner.z() = 0.1 * random.normal();
  Vec3 newell = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < bent.size(); ++i)
    newell += (bent[i] - bent[0]).cross(bent[i + 1] - bent[0]);
  EXPECT_NEAR((areas(bent).first - newell).norm(), 0.0, 1e-12);  // rounding of 18 products
}

TEST(CutPolygon, TakesCornersOnAStraightSide) {
  const Polygon square = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  EXPECT_EQ(cut_polygon(square).size(), 3u);
  EXPECT_EQ(areas(square).second, 8.0);
}

TEST(CutPolygon, GivesNothingForWhatHasNoInside) {
  EXPECT_TRUE(cut_polygon(Polygon{{0, 0, 0}, {3, 1, 0}, {3, 0, 0}, {0, 2, 0}}).empty());  // crosses
  EXPECT_TRUE(cut_polygon(Polygon{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}).empty());
  EXPECT_TRUE(cut_polygon(Polygon{{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {2, 2, 0}, {0, 2, 0}}).empty());
}

// The star's inside is what the sum of its triangles' areas says, whatever its spikes.
TEST(CutPolygon, CoversRandomStarsOnce) {
  Random random(2);
  for (int draw = 0; draw < 200; ++draw) {
    Polygon star;
    const int corners = 4 + random.below(40);
    for (int i = 0; i < corners; ++i) {
      const double angle = 2.0 * M_PI * i / corners, radius = 0.05 + random.uniform();
      star.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.0});
    }
    double twice = 0.0;
    for (int i = 0; i < corners; ++i) twice += star[i].cross(star[(i + 1) % corners]).z();
    EXPECT_EQ(cut_polygon(star).size(), star.size() - 2);
    EXPECT_NEAR(areas(star).second, twice, 1e-13);
  }
}

}  // namespace
}  // namespace palpation
