#include "draw/axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace palpation::draw {
namespace {

std::vector<std::string> labels(const std::vector<Tick>& ticks) {
  std::vector<std::string> words;
  for (const Tick& tick : ticks) words.push_back(tick.label);
  return words;
}

using Words = std::vector<std::string>;

TEST(Ticks, AreRoundNumbersWithAsManyDecimalsAsTheStepNeeds) {
  EXPECT_EQ(labels(ticks(0.0, 10.0, 5)), (Words{"0", "2", "4", "6", "8", "10"}));
  EXPECT_EQ(labels(ticks(0.0, 1.0, 2)), (Words{"0.0", "0.5", "1.0"}));
  EXPECT_EQ(labels(ticks(7.03, 7.11, 4)), (Words{"7.04", "7.06", "7.08", "7.10"}));
}

TEST(Ticks, WriteATrueMinusAndNoMinusAtZero) {
  EXPECT_EQ(labels(ticks(-0.5, 0.5, 2)), (Words{"\u22120.5", "0.0", "0.5"}));
}

TEST(Ticks, ReachBothEndsWhereTheseAreRoundNumbersThemselves) {
  const std::vector<Tick> marks = ticks(0.1, 0.3, 2);  // neither end is a double of its own
  ASSERT_EQ(marks.size(), 3u);
  EXPECT_NEAR(marks.front().value, 0.1, 1e-15);
  EXPECT_NEAR(marks.back().value, 0.3, 1e-15);
}

TEST(Ticks, AreNoneOfAnAxisWithoutLength) {
  EXPECT_TRUE(ticks(3.0, 3.0, 5).empty());
  EXPECT_TRUE(ticks(4.0, 3.0, 5).empty());
  EXPECT_TRUE(ticks(0.0, std::nan(""), 5).empty());
  EXPECT_TRUE(ticks(0.0, INFINITY, 5).empty());
}

// The step is at least the length over `wanted`, and less than 2.5 times that (from 2 to 5).
TEST(Ticks, LieWithinTheAxisEvenlyAndAreNotTooMany) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-50.0, 50.0), exponent(-6.0, 4.0);
  for (int trial = 0; trial < 1000; ++trial) {
    const double lowest = place(random);
    const double length = std::pow(10.0, exponent(random));
    const std::vector<Tick> marks = ticks(lowest, lowest + length, 6);
    ASSERT_GE(marks.size(), 2u) << lowest << " + " << length;
    ASSERT_LE(marks.size(), 7u) << lowest << " + " << length;
    const double slack = 1e-8 * length;  // of the step, which a tick may lie beyond the end by
    EXPECT_GE(marks.front().value, lowest - slack);
    EXPECT_LE(marks.back().value, lowest + length + slack);
    const double step = marks[1].value - marks[0].value;
    for (std::size_t i = 1; i < marks.size(); ++i)
      EXPECT_NEAR(marks[i].value - marks[i - 1].value, step, 1e-9 * step + 1e-12);
  }
}

TEST(LogarithmicTicks, LabelPowersOfTenAlone) {
  const std::vector<Tick> marks = logarithmic_ticks(1.0, 1000.0);
  Words named;
  for (const Tick& mark : marks) {
    if (!mark.label.empty()) named.push_back(mark.label);
  }
  EXPECT_EQ(marks.size(), 28u);  // nine in each of three decades, and the last
  EXPECT_EQ(named, (Words{"1", "10", "100", "1000"}));
}

TEST(LogarithmicTicks, LabelTwoAndFiveTooWhereTheAxisIsShort) {
  EXPECT_EQ(labels(logarithmic_ticks(1.0, 10.0)),
            (Words{"1", "2", "", "", "5", "", "", "", "", "10"}));
}

TEST(LogarithmicTicks, AreNoneWhereThereIsNoLogarithm) {
  EXPECT_TRUE(logarithmic_ticks(0.0, 10.0).empty());
  EXPECT_TRUE(logarithmic_ticks(-1.0, 10.0).empty());
  EXPECT_TRUE(logarithmic_ticks(2.0, 2.0).empty());
}

TEST(ShortNumber, KeepsSignificantDigitsWithoutTrailingZeros) {
  EXPECT_EQ(short_number(0.0625, 3), "0.0625");
  EXPECT_EQ(short_number(2.50, 3), "2.5");
  EXPECT_EQ(short_number(1234567.0, 3), "1234567");
  EXPECT_EQ(short_number(-3.0, 3), "\u22123");
}

}  // namespace
}  // namespace palpation::draw
