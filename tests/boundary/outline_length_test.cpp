#include "boundary/outline_length.h"

#include <gtest/gtest.h>

#include "boundary/meshes.h"

namespace palpation {
namespace {

using testing::field_of;
using testing::unit_square;

TEST(OutlineLength, LeavesOutTheTissuesBorder) {
  const Surface square = unit_square(11);
  const Field x = field_of(square, [](const Vec3& at) { return at.x(); });
  const std::vector<LevelLoop> half = level_loops(square, x, 0.45);
  ASSERT_EQ(half.size(), 1U);
  EXPECT_NEAR(outline_length(square, half), 1.0, 1e-12);
  EXPECT_EQ(outline_length(square, level_loops(square, x, -1.0)), 0.0);
  EXPECT_EQ(outline_length(square, {}), 0.0);
}

}  // namespace
}  // namespace palpation
