// Intervals against values that others printed.
#include "experiments/intervals.h"

#include <gtest/gtest.h>

#include <array>

#include "palpation/base/error.h"

namespace palpation::tool {
namespace {

// R 4.2: prop.test(0, 10, correct = FALSE)$conf.int and prop.test(5, 10, correct = FALSE)$conf.int.
TEST(WilsonInterval, IsThatOfR) {
  const Interval none = wilson_interval(0, 10), half = wilson_interval(5, 10);
  EXPECT_EQ(none.low, 0.0);
  EXPECT_NEAR(none.high, 0.2775328, 1e-7);  // seven digits are printed
  EXPECT_NEAR(half.low, 0.2365931, 1e-7);
  EXPECT_NEAR(half.high, 0.7634069, 1e-7);
}

TEST(WilsonInterval, OfAllIsTheMirrorOfNone) {
  const Interval all = wilson_interval(10, 10);
  EXPECT_NEAR(all.low, 1.0 - wilson_interval(0, 10).high, 1e-15);  // rounding
  EXPECT_EQ(all.high, 1.0);
}

TEST(WilsonInterval, RefusesWhatIsNoShare) {
  EXPECT_THROW(wilson_interval(0, 0), InvalidInput);
  EXPECT_THROW(wilson_interval(3, 2), InvalidInput);
  EXPECT_THROW(wilson_interval(1, 2, 1.0), InvalidInput);
}

// Mean 5/2, variance 5/3, Student's t of three degrees of freedom 3.182446 (any table).
TEST(MeanInterval, IsStudents) {
  const std::array values = {1.0, 2.0, 3.0, 4.0};
  const std::optional<Interval> interval = mean_interval(values);
  ASSERT_TRUE(interval);
  EXPECT_NEAR(interval->low, 2.5 - 3.182446 * 0.6454972, 1e-6);  // as many digits as the table has
  EXPECT_NEAR(interval->high, 2.5 + 3.182446 * 0.6454972, 1e-6);
}

TEST(MeanInterval, OfOneValueIsNotKnown) {
  const std::array one = {1.0};
  EXPECT_FALSE(mean_interval(one));
}

}  // namespace
}  // namespace palpation::tool
