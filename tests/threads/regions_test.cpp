// Regions that pass from thread to thread: made in one, copied, read and dropped in others, the
// last of which destroys their exact numbers. ThreadSanitizer sees all of this but what happens
// inside GMP, which keeps no state, and VTK.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <thread>
#include <vector>

#include "boundary/meshes.h"
#include "boundary/polygons.h"
#include "palpation/boundary/level_set.h"
#include "palpation/boundary/region_error.h"

namespace palpation {
namespace {

using testing::region_of;
using testing::same;
using testing::star;

constexpr int kThreads = 4;

void in_parallel(const std::function<void(int)>& work) {
  std::vector<std::thread> threads;
  for (int i = 0; i < kThreads; ++i) threads.emplace_back(work, i);
  for (std::thread& thread : threads) thread.join();
}

TEST(ThreadsOfRegions, HandRegionsOverToEachOther) {
  Random random(32);
  std::array<Region, kThreads> made;
  std::vector<Ring> rings;
  for (int i = 0; i < kThreads; ++i) rings.push_back(star(random, {0.2 * i, 0.0}, 1.0, 30));
  in_parallel([&](int thread) {
    made[thread] = subtract(region_of(rings[thread]), region_of(rings[(thread + 1) % kThreads]));
  });
  std::array<Region, kThreads> taken = made;
  std::array<Region, kThreads> sums;
  in_parallel([&](int thread) {
    for (int i = 0; i < kThreads; ++i) {
      const Region copy = taken[i];
      sums[thread] = unite(sums[thread], copy);
    }
  });
  taken = {};
  for (const Region& sum : sums) EXPECT_TRUE(same(sum, sums[0]));
}

TEST(ThreadsOfRegions, ShareASurfaceWhoseChartIsNotMadeYet) {
  Random random(33);
  const Surface tissue(
      zoo::moved(zoo::jittered_square_mesh(12, 3), zoo::some_rotation(), Vec3(1.0, 2.0, 3.0)));
  const Field field = testing::smooth_field(tissue, random);
  std::array<std::vector<double>, kThreads> numbers;
  in_parallel([&](int thread) {
    const Region region = superlevel_region(tissue, field, 0.1);
    const RegionError error =
        compare(tissue, region, superlevel_region(tissue, field, 0.1 * (1 + thread % 2)));
    numbers[thread] = {region.area(), static_cast<double>(level_loops(tissue, field, 0.1).size()),
                       superlevel_area(tissue, field, 0.1)};
    EXPECT_TRUE(thread % 2 == 1 || error.symmetric_difference_m2 == 0.0);
  });
  for (const std::vector<double>& others : numbers) EXPECT_EQ(others, numbers[0]);
}

TEST(ThreadsOfRegions, RefuseTogether) {
  in_parallel([](int) {
    for (int i = 0; i < 20; ++i)
      EXPECT_THROW(region_of({{0, 0}, {2, 2}, {2, 0}, {0, 2}}), InvalidInput);
  });
}

}  // namespace
}  // namespace palpation
