#include "readings/contact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "readings/tissue.h"

namespace palpation {
namespace {

/// Readings of a disk, multiplied and lowered the more the farther along x: what a probe does that
/// loses its contact.
std::vector<Palpation> readings(const Surface& tissue, int count, double fade, double noise) {
  Random random(3);
  std::vector<Palpation> made;
  for (int i = 0; i < count; ++i) {
    Palpation palpation = touch(tissue, random.below(tissue.vertex_count()), 0.0);
    const Vec3 p = tissue.position(palpation.where);
    const double share = p.x() / 0.025;
    const double amplitude =
        2.0 / (1.0 + std::exp(1400.0 * ((p - Vec3(0.0115, 0.030, 0.0)).norm() - 0.00625)));
    palpation.reading =
        7.0 - fade * share + (1.0 - fade * share) * amplitude + noise * random.normal();
    made.push_back(palpation);
  }
  return made;
}

TEST(FadingContact, IsToldWithItsDirection) {
  const Surface tissue = plane(26, 51);
  const auto fading = fading_contact(tissue, readings(tissue, 500, 0.8, 0.02));
  ASSERT_TRUE(fading.has_value());
  EXPECT_GT(fading->towards.x(), 0.95);
  EXPECT_GT(fading->base_fall,
            0.3);  // 0.8 of a contrast of 2, or less where the tumour itself has faded
  EXPECT_LT(fading->amplitude_left, 0.7);
}

TEST(FadingContact, IsNotSeenInSoundReadings) {
  const Surface tissue = plane(26, 51);
  for (const int count : {25, 100, 500}) {
    for (const double noise : {0.0, 0.02, 0.2, 0.5}) {
      EXPECT_FALSE(fading_contact(tissue, readings(tissue, count, 0.0, noise)).has_value())
          << count << " " << noise;
    }
  }
}

// What is left of four high readings where all others are the same number is no slope of these.
TEST(FadingContact, IsNotSeenInReadingsWithoutNoise) {
  const Surface tissue = plane(15, 15);
  std::vector<Palpation> made;
  for (int vertex = 0; vertex < tissue.vertex_count(); ++vertex)
    made.push_back(touch(tissue, vertex, 5.0));
  for (const int vertex : {32, 33, 47, 48}) made[static_cast<std::size_t>(vertex)].reading = 6.0;
  EXPECT_FALSE(fading_contact(tissue, made));
}

TEST(FadingContact, IsNotSeenWhereTouchesCrowdAtATumour) {
  const Surface tissue = plane(26, 51);
  int seen = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    std::vector<Palpation> made;
    for (int i = 0; i < 105; ++i) {
      const double angle = 6.283 * random.uniform(),
                   distance_m = 0.00625 + 0.0015 * random.normal();
      const Vec3 at_edge =
          Vec3(0.0115, 0.030, 0.0) + distance_m * Vec3(std::cos(angle), std::sin(angle), 0.0);
      const Vec3 anywhere(0.025 * random.uniform(), 0.050 * random.uniform(), 0.0);
      Palpation palpation;
      palpation.where = tissue.project(i < 35 ? anywhere : at_edge);
      const double depth_m =
          0.00625 - (tissue.position(palpation.where) - Vec3(0.0115, 0.030, 0.0)).norm();
      palpation.reading = 7.0 + 2.0 / (1.0 + std::exp(-1400.0 * depth_m)) + 0.1 * random.normal();
      made.push_back(palpation);
    }
    seen += fading_contact(tissue, made).has_value();
  }
  EXPECT_EQ(seen, 0);
}

TEST(FadingContact, OfFewOrAlikeReadingsNothingIsSaid) {
  const Surface tissue = plane(26, 51);
  EXPECT_FALSE(fading_contact(tissue, {}).has_value());
  EXPECT_FALSE(fading_contact(tissue, readings(tissue, 19, 0.8, 0.0)).has_value());
  std::vector<Palpation> alike = readings(tissue, 30, 0.0, 0.0), line;
  for (Palpation& palpation : alike) palpation.reading = 7.0;
  EXPECT_FALSE(fading_contact(tissue, alike).has_value());
  for (int i = 0; i < 26; ++i) line.push_back(touch(tissue, i, 7.0 + 0.1 * i));
  EXPECT_FALSE(fading_contact(tissue, line).has_value());
}

}  // namespace
}  // namespace palpation
