#include "belief/aligned.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "palpation/belief/memory.h"

namespace palpation {
namespace {

constexpr std::size_t kLarge = std::size_t{1} << 20;

TEST(Aligned, LiesOnABorderOfCacheLinesAndCanBeWrittenToItsEnd) {
  for (const std::size_t count :
       {std::size_t{0}, std::size_t{1}, std::size_t{1000}, kLarge / 8 + 1, kLarge}) {
    const AlignedDoubles values = aligned_doubles(count);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(values.get()) % 64, 0u);
    for (std::size_t i = 0; i < count; ++i) values[i] = 1.0;
  }
}

TEST(Aligned, LargeArraysAreHandedOutAgainToThoseOfAboutTheirSize) {
  AlignedDoubles first = aligned_doubles(kLarge);
  const double* const memory = first.get();
  first.reset();
  const AlignedDoubles smaller = aligned_doubles(kLarge / 2),
                       next = aligned_doubles(kLarge / 2 + 1);
  EXPECT_NE(smaller.get(), memory);
  EXPECT_EQ(next.get(), memory);
  EXPECT_NE(aligned_doubles(kLarge).get(), memory) << "one array is in use";
}

TEST(Aligned, TheLastThatWasFreedIsTheFirstHandedOutAndReleasingTwiceIsNoHarm) {
  AlignedDoubles first = aligned_doubles(kLarge), second = aligned_doubles(kLarge);
  const double* const memory = second.get();
  first.reset();
  second.reset();
  EXPECT_EQ(aligned_doubles(kLarge).get(), memory);
  release_memory();
  release_memory();
}

TEST(Aligned, NoMoreIsKeptThanHalfAGigabyte) {
  std::vector<AlignedDoubles> many;
  for (int i = 0; i < 80; ++i) many.push_back(aligned_doubles(kLarge));
  const double* const first = many.front().get();
  for (AlignedDoubles& array : many) array.reset();
  many.clear();
  for (int i = 0; i < 60; ++i) {
    many.push_back(aligned_doubles(kLarge));
    EXPECT_NE(many.back().get(), first) << "the first that was freed is gone";
  }
}

}  // namespace
}  // namespace palpation
