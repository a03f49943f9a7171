#include "palpation/world/catalogue.h"

#include <gtest/gtest.h>

#include "palpation/base/error.h"
#include "world/tissue.h"

namespace palpation {
namespace {

bool is_without_tumour(const WorldFamily& family) {
  return family.words.starts_with("no tumour") || family.name == "healthy";
}

TEST(Catalogue, DrawsTheSameWorldFromTheSameStreamAndAnotherFromTheNext) {
  const Surface surface = sheet(0.025, 0.050, 0.001);
  for (const WorldFamily& family : world_families()) {
    if (is_without_tumour(family)) continue;
    SCOPED_TRACE(family.name);
    const auto truth = [&](std::uint64_t seed) {
      Random random(seed);
      return Phantom(surface, draw_world(family.name, random, {}).design).truth();
    };
    EXPECT_EQ(truth(1), truth(1));
    EXPECT_NE(truth(1), truth(2));
  }
}

// On every tissue that the experiments use, twenty of each.
TEST(Catalogue, HasSomethingToFindWhereItSaysSo) {
  for (const Vec2& size : {Vec2(0.025, 0.050), Vec2(0.040, 0.060), Vec2(0.054, 0.049)}) {
    const Surface surface = sheet(size.x(), size.y(), 0.001);
    for (const WorldFamily& family : world_families()) {
      for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(family.name + " " + std::to_string(seed));
        Random random(seed);
        const DrawnWorld world = draw_world(family.name, random, {.size_m = size});
        const Phantom phantom(surface, world.design);
        EXPECT_EQ(phantom.truth().maxCoeff() >= phantom.true_level(), !is_without_tumour(family));
        EXPECT_LT(phantom.truth().minCoeff(), phantom.true_level());
      }
    }
  }
}

TEST(Catalogue, LiesWhereTheTissueDoes) {
  const Vec3 corner(0.1, -0.2, 0.0);
  Random here(4), there(4);
  const DrawnWorld one = draw_world("two", here, {});
  const DrawnWorld other = draw_world("two", there, {.corner_m = corner});
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(std::get<Disk>(one.design.lumps[i].outline).centre_m + corner,
              std::get<Disk>(other.design.lumps[i].outline).centre_m);
}

TEST(Catalogue, RefusesWhatItDoesNotHaveAndTissueTooSmall) {
  Random random(1);
  EXPECT_THROW(draw_world("cube", random, {}), InvalidInput);
  EXPECT_THROW(draw_world("two", random, {.size_m = Vec2(0.010, 0.010)}), InvalidInput);
}

}  // namespace
}  // namespace palpation
