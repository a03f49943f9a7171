#include "scene/words.h"

#include <gtest/gtest.h>

namespace palpation::tool {
namespace {

TEST(Percent, TellsNothingAsImpossibleOrCertainThatIsNot) {
  EXPECT_EQ(percent(0.0), "0 %");
  EXPECT_EQ(percent(1e-6), "0.0001 %");
  EXPECT_EQ(percent(0.001), "0.1 %");
  EXPECT_EQ(percent(0.05), "5 %");
  EXPECT_EQ(percent(0.5), "50 %");
  EXPECT_EQ(percent(0.995), "99.5 %");
  EXPECT_EQ(percent(0.9999), "over 99.9 %");
  EXPECT_EQ(percent(1.0), "100 %");
}

}  // namespace
}  // namespace palpation::tool
