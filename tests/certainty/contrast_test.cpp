#include "certainty/contrast.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "palpation/base/random.h"

namespace palpation {
namespace {

std::vector<double> noise(int count, double sd, Random& random) {
  std::vector<double> readings;
  for (int i = 0; i < count; ++i) readings.push_back(7.0 + sd * random.normal());
  return readings;
}

TEST(ShowsContrast, NeedsTwoPlateausOrASmoothField) {
  Random random(1);
  std::vector<double> readings = noise(25, 0.1, random);
  EXPECT_FALSE(shows_contrast(readings, 0.0));
  EXPECT_TRUE(shows_contrast(readings, 5.1));
  readings.push_back(9.0);
  EXPECT_TRUE(shows_contrast(readings, 0.0));
  EXPECT_FALSE(
      shows_contrast(std::vector<double>{7.0, 7.01, 9.0}, 0.0));  // three readings say nothing
}

TEST(ShowsContrast, IsSeldomFooledByNoise) {
  Random random(2);
  int fooled = 0;
  for (int trial = 0; trial < 500; ++trial) fooled += shows_contrast(noise(100, 0.5, random), 0.0);
  EXPECT_LE(fooled, 5);
}

/// Each of whose errors keeps nine tenths of the one before, beside stripes of nine readings.
std::vector<double> errors_that_last(std::uint64_t seed, double sd, double stripes) {
  Random random(seed);
  std::vector<double> readings;
  double error = sd * random.normal();
  for (int i = 0; i < 600; ++i) {
    error = 0.9 * error + std::sqrt(1.0 - 0.81) * sd * random.normal();
    readings.push_back(7.0 + error + (i / 9 % 3 == 0 ? stripes : 0.0));
  }
  return readings;
}

// Six hundred that err alike over ten readings look like two plateaus now and then; thirty of them,
// each so far from the next that it errs for itself, in none of twenty rows.
TEST(TwoPlateausInTurn, AreNotOfErrorsThatLast) {
  int all = 0, apart = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::vector<double> readings = errors_that_last(seed, 0.3, 0.0);
    all += two_plateaus(readings)->evidence > 5.3;
    apart += evidence_of_two_plateaus_in_turn(readings, 20) > 5.3;
  }
  EXPECT_GE(all, 1);
  EXPECT_EQ(apart, 0);
}

TEST(TwoPlateausInTurn, AreOfStripesThatAreFinerThanThose) {
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    EXPECT_GT(evidence_of_two_plateaus_in_turn(errors_that_last(seed, 0.3, 2.0), 20), 8.0) << seed;
}

using Numbers = std::vector<std::size_t>;

TEST(ReadingsApart, LieFartherFromAllOthersThanThoseFromEachOther) {
  Random random(4);
  std::vector<double> readings = noise(40, 0.1, random);
  EXPECT_FALSE(readings_apart(readings, few_of(readings.size())));
  readings[17] = 9.0;
  EXPECT_EQ(readings_apart(readings, few_of(readings.size()))->numbers, Numbers{17});
  readings[17] = 4.0;
  EXPECT_EQ(readings_apart(readings, few_of(readings.size()))->numbers, Numbers{17});
  readings[8] = 40.0;  // behind which the other would hide
  EXPECT_EQ(readings_apart(readings, few_of(readings.size()))->numbers, (Numbers{8, 17}));
  EXPECT_EQ(readings_apart(readings, 1)->numbers, Numbers{8});
  readings[21] = 1.0;  // three of forty are not few
  EXPECT_EQ(few_of(readings.size()), 2u);
  EXPECT_EQ(readings_apart(readings, 2)->numbers, Numbers{8});
  std::vector<double> few = noise(29, 0.1, random);
  few[3] = 9.0;
  EXPECT_FALSE(readings_apart(few, few_of(few.size())));
  EXPECT_FALSE(readings_apart(std::vector<double>(40, 7.0), 2));
}

TEST(ReadingsApart, IsAsFarOutAsTheNearestOfThem) {
  std::vector<double> readings(60, 0.0);
  for (std::size_t i = 0; i < readings.size(); ++i)
    readings[i] = 0.01 * static_cast<double>(i % 11);
  readings[7] = 30.1;
  readings[9] = -5.0;
  readings[50] = 1000.0;
  const std::optional<ReadingsApart> apart = readings_apart(readings, few_of(readings.size()));
  EXPECT_EQ(apart->numbers, (Numbers{7, 9, 50}));
  EXPECT_NEAR(apart->spans, 50.0, 1e-9);
}

TEST(TwoPlateaus, FindsThemWhereNoiseIsAQuarterOfTheirDistance) {
  Random random(3);
  std::vector<double> readings = noise(80, 0.5, random);
  for (int i = 0; i < 25; ++i) readings.push_back(9.0 + 0.5 * random.normal());
  const auto plateaus = two_plateaus(readings);
  ASSERT_TRUE(plateaus);
  EXPECT_NEAR(plateaus->low, 7.0, 0.2);
  EXPECT_NEAR(plateaus->high, 9.0, 0.4);
  EXPECT_GT(plateaus->evidence, 5.0);
}

// A sensor that counts in steps makes two or three values of noise, which look like plateaus.
TEST(ShowsContrast, OfNoiseThatIsRoundedToAFewValuesIsSeldomSeen) {
  Random random(5);
  int seen = 0;
  for (const double steps : {0.2, 0.3, 0.5, 1.0, 2.0}) {
    for (int run = 0; run < 40; ++run) {
      std::vector<double> readings = noise(100, steps, random);
      const double origin = random.uniform();
      for (double& reading : readings) reading = 7.0 + std::round(reading - 7.0 + origin);
      seen += shows_contrast(readings, 0.0);
    }
  }
  EXPECT_LE(seen, 2);
}

// Two of its values differ by what arithmetic leaves: the step is a billionth of the contrast.
TEST(ShowsContrast, OfEqualReadingsIsSeenWhateverTheLeastStepIs) {
  std::vector<double> readings(80, 7.0);
  readings.resize(105, 9.0);
  readings[3] = 7.0 + 2e-9;
  EXPECT_TRUE(shows_contrast(readings, 0.0));
}

TEST(ShowsContrast, OfRoundedPlateausThatAreStepsApartIsSeen) {
  Random random(6);
  std::vector<double> readings = noise(80, 0.4, random);
  for (int i = 0; i < 25; ++i) readings.push_back(15.0 + 0.4 * random.normal());
  for (double& reading : readings) reading = std::round(reading);
  EXPECT_TRUE(shows_contrast(readings, 0.0));
}

TEST(TwoPlateaus, AreNotThereWhereReadingsAreFewOrAlike) {
  EXPECT_FALSE(two_plateaus(std::vector<double>{}));
  EXPECT_FALSE(two_plateaus(std::vector<double>(9, 7.0)));
  EXPECT_FALSE(two_plateaus(std::vector<double>(30, 7.0)));
}

TEST(TwoPlateaus, FollowScaleAndOrigin) {
  Random random(4);
  std::vector<double> readings = noise(40, 0.3, random), moved;
  for (int i = 0; i < 10; ++i) readings.push_back(8.5 + 0.3 * random.normal());
  for (const double reading : readings) moved.push_back(1e-6 * reading - 3.0);
  EXPECT_NEAR(two_plateaus(moved)->high, 1e-6 * two_plateaus(readings)->high - 3.0, 1e-12);
  EXPECT_NEAR(two_plateaus(moved)->evidence, two_plateaus(readings)->evidence, 1e-5);
}

}  // namespace
}  // namespace palpation
