#include "belief/sites.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpation {
namespace {

Site site_of(const std::vector<double>& readings, const std::vector<double>& variances) {
  Site site;
  site.known = readings;
  site.known_variances = variances;
  return site;
}

// Weights 1/1 and 1/4: the mean is (1 * 10 + 0.25 * 20) / 1.25 = 12, its variance 1/1.25 = 0.8.
TEST(Merge, WeighsReadingsByTheirPrecision) {
  const MergedReading merged = merge(site_of({10.0, 20.0}, {1.0, 4.0}), 0.0);
  EXPECT_EQ(merged.mean, 12.0);
  EXPECT_EQ(merged.variance, 0.8);
}

// The same in any unit: powers of two change no digit, and the least variances there are do not
// overflow.
TEST(Merge, ScalesWithTheVariances) {
  for (const int exponent : {-1060, -1000, -60, 0, 60, 1000}) {
    const double scale = std::ldexp(1.0, exponent);
    const MergedReading merged = merge(site_of({10.0, 20.0}, {scale, 4.0 * scale}), 0.0);
    EXPECT_EQ(merged.mean, 12.0) << exponent;
    EXPECT_NEAR(merged.variance / scale, 0.8, exponent < -1022 ? 0.01 : 0.0)
        << exponent;  // few digits are left in the last one
  }
}

TEST(Merge, GivesNoWeightToReadingsThatSayNothing) {
  const MergedReading merged = merge(site_of({10.0, 20.0}, {1e-300, 1e300}), 0.0);
  EXPECT_EQ(merged.mean, 10.0);
  EXPECT_EQ(merged.variance, 1e-300);
}

}  // namespace
}  // namespace palpation
