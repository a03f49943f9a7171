// How long the rest of counted work takes, in words.
#include <gtest/gtest.h>

#include "scene/progress.h"

namespace palpation::tool {
namespace {

TEST(LeftWords, GoOnAtThePaceOfWhatIsDone) {
  EXPECT_EQ(left_words(2, 10, 6.0, 6.0), "about 24 s left");
  EXPECT_EQ(left_words(2, 10, 6.0, 10.0), "about 20 s left");
  EXPECT_EQ(left_words(1, 61, 10.0, 10.0), "about 10 min 0 s left");
}

TEST(LeftWords, AreNoneWhereNothingIsKnownOrTheWorkIsShort) {
  EXPECT_EQ(left_words(0, 10, 0.0, 5.0), "");
  EXPECT_EQ(left_words(10, 10, 5.0, 5.0), "");
  EXPECT_EQ(left_words(5, 10, 0.9, 0.9), "");
  EXPECT_EQ(left_words(2, 3, 6.0, 9.5), "");  // it takes longer than the pace says
}

}  // namespace
}  // namespace palpation::tool
