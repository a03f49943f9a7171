#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "palpation/base/contract.h"
#include "palpation/base/parallel.h"
#include "palpation/base/random.h"

namespace palpation {
namespace {

TEST(Random, IsTheSameStreamOnEveryMachine) {
  // xoshiro256** seeded with splitmix64(42): values from an independent implementation of the two
  // published algorithms.
  Random random(42);
  EXPECT_EQ(random.bits(), 1546998764402558742u);
  EXPECT_EQ(random.bits(), 6990951692964543102u);
  EXPECT_EQ(random.bits(), 12544586762248559009u);
}

TEST(Random, UniformsFillTheUnitIntervalEvenly) {
  Random random(1);
  constexpr int kCount = 100000;
  double sum = 0.0, square = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u / kCount;
    square += u * u / kCount;
  }
  // Standard errors are 0.0009 and 0.0009: five of them.
  EXPECT_NEAR(sum, 1.0 / 2.0, 0.0046);
  EXPECT_NEAR(square, 1.0 / 3.0, 0.0047);
}

TEST(Random, NormalsHaveTheMomentsOfANormal) {
  Random random(2);
  constexpr int kCount = 100000;
  double mean = 0.0, square = 0.0, fourth = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double z = random.normal();
    mean += z / kCount;
    square += z * z / kCount;
    fourth += z * z * z * z / kCount;
  }
  // Standard errors are 0.0032, 0.0045 and 0.031: five of them.
  EXPECT_NEAR(mean, 0.0, 0.016);
  EXPECT_NEAR(square, 1.0, 0.023);
  EXPECT_NEAR(fourth, 3.0, 0.16);
}

TEST(Random, BelowDrawsEveryNumberAsOften) {
  Random random(3);
  std::vector<int> counts(7, 0);
  for (int i = 0; i < 70000; ++i) ++counts[random.below(7)];
  for (int count : counts)
    EXPECT_NEAR(count, 10000, 470);  // five standard deviations of a binomial
  EXPECT_THROW(random.below(0), InvalidInput);
}

TEST(Random, SplitStreamsDiffer) {
  Random random(4);
  Random other = random.split();
  EXPECT_NE(random.bits(), other.bits());
}

TEST(ForRanges, CoversEveryIndexOnceAtAnyNumberOfThreads) {
  for (int threads : {1, 2, 5}) {
    set_thread_count(threads);
    std::vector<std::atomic<int>> visits(1003);
    for_ranges(1003, 10, [&](int first, int last) {
      for (int i = first; i < last; ++i) ++visits[i];
    });
    for (const auto& count : visits) EXPECT_EQ(count.load(), 1);
  }
}

TEST(ForRanges, PassesOnWhatItsWorkThrows) {
  set_thread_count(2);
  EXPECT_THROW(
      for_ranges(100, 1,
                 [](int first, int) { require(first < 50, "work", "range", "is too far"); }),
      InvalidInput);
  int calls = 0;
  for_ranges(0, 8, [&](int, int) { ++calls; });
  EXPECT_EQ(calls, 0);
  EXPECT_THROW(set_thread_count(0), InvalidInput);
}

TEST(Require, SaysFunctionValueAndRuleInWordsAndAsData) {
  try {
    require(false, "disk", "radius -1", "must be positive");
    FAIL() << "nothing was thrown";
  } catch (const BrokenContract& error) {
    EXPECT_STREQ(error.what(), "disk: radius -1 must be positive");
    EXPECT_EQ(error.function(), "disk");
    EXPECT_EQ(error.value(), "radius -1");
    EXPECT_EQ(error.rule(), "must be positive");
    EXPECT_EQ(rule_words(error), "radius -1 must be positive");
  }
  EXPECT_EQ(rule_words(InvalidInput("all that is known")), "all that is known");
}

TEST(TextOf, ReadsBackAsTheSameDouble) {
  for (double value : {0.1, 1.0 / 3.0, 1e300, 5e-324, -0.0, 12345678.9})
    EXPECT_EQ(std::strtod(text_of(value).c_str(), nullptr), value);
  EXPECT_EQ(text_of(0.5), "0.5");
  EXPECT_EQ(text_of(std::numeric_limits<double>::quiet_NaN()), "nan");
}

}  // namespace
}  // namespace palpation
