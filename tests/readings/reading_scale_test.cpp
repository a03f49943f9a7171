#include "palpation/readings/reading_scale.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpation/readings/screening.h"

namespace palpation {
namespace {

TEST(ReadingScale, LeadsBackToTheReading) {
  for (const double reading : {1e-6, 0.17, 4.66, 1e6}) {
    EXPECT_NEAR(as_reading(ReadingScale::Log, on_scale(ReadingScale::Log, reading)), reading,
                1e-14 * reading);
    EXPECT_EQ(on_scale(ReadingScale::Raw, reading), reading);
    EXPECT_EQ(as_reading(ReadingScale::Raw, reading), reading);
  }
}

// d exp(x) / dx = exp(x).
TEST(ReadingScale, TellsHowFarAStepGoes) {
  EXPECT_EQ(reading_per_step(ReadingScale::Raw, 3.0), 1.0);
  EXPECT_NEAR(reading_per_step(ReadingScale::Log, std::log(3.0)), 3.0, 1e-15);
}

// Of 2 +- .1, which is 5 %: log 2 +- .05. The field's own noise stays that.
TEST(ReadingScale, TakesNoiseAsAPartOfTheReading) {
  const std::vector<Palpation> log =
      on_scale(ReadingScale::Log,
               std::vector<Palpation>{{.where = {}, .reading = 2.0, .noise_variance = 0.01},
                                      {.where = {}, .reading = 3.0}});
  EXPECT_NEAR(log[0].reading, std::log(2.0), 1e-15);
  EXPECT_NEAR(log[0].noise_variance, 0.0025, 1e-18);
  EXPECT_TRUE(std::isnan(log[1].noise_variance));
}

TEST(ReadingScale, TakesZeroForLostContactAndLessForNoReadingOfThatScale) {
  const std::vector<Palpation> log =
      on_scale(ReadingScale::Log,
               std::vector<Palpation>{{.where = {}, .reading = 0.0},
                                      {.where = {}, .reading = -1.0, .set_aside = "by hand"},
                                      {.where = {}, .reading = 1.0},
                                      {.where = {}, .reading = -1.0}});
  EXPECT_EQ(log[0].set_aside, kNoContact);
  EXPECT_EQ(log[1].set_aside, "by hand");
  EXPECT_TRUE(log[2].set_aside.empty());
  EXPECT_EQ(log[3].set_aside, kNoLogarithm);
}

}  // namespace
}  // namespace palpation
