// Whether the ground was felt both before a change and since.
#include "exploration/felt_since.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "belief/tissue.h"

namespace palpation {
namespace {

Surface wide_tissue() {
  Random random(0);
  return Surface(make_plane({.size_m = {0.054, 0.049}, .columns = 55, .rows = 50}, random));
}

/// So far apart, row by row, shifted by so much.
std::vector<Palpation> rows(const Surface& tissue, double apart_m, const Vec3& from) {
  std::vector<Palpation> made;
  for (double y = from.y(); y < 0.049; y += apart_m) {
    for (double x = from.x(); x < 0.054; x += apart_m)
      made.push_back({.where = tissue.project(Vec3(x, y, 0.0))});
  }
  return made;
}

Misfit since(std::size_t number) { return {.kind = MisfitKind::Moved, .number = number}; }

TEST(IsFeltAgain, NotARasterThatGoesOn) {
  const Surface tissue = wide_tissue();
  for (const double apart_m : {0.0025, 0.004, 0.006}) {
    const std::vector<Palpation> raster = rows(tissue, apart_m, Vec3(0.001, 0.001, 0.0));
    EXPECT_FALSE(is_felt_again(since(raster.size() / 2), tissue, raster)) << apart_m;
  }
}

// Those that are chosen lie as far from all before them as they can, five millimetres here.
TEST(IsFeltAgain, TouchesThatSpreadBetweenOthers) {
  const Surface tissue = wide_tissue();
  std::vector<Palpation> spread = rows(tissue, 0.0075, Vec3(0.001, 0.001, 0.0));
  const std::size_t before = spread.size();
  for (const Palpation& one : rows(tissue, 0.0075, Vec3(0.00475, 0.00475, 0.0)))
    spread.push_back(one);
  EXPECT_TRUE(is_felt_again(since(before), tissue, spread));
  EXPECT_TRUE(is_felt_again(since(before / 2), tissue, spread));
}

TEST(IsFeltAgain, ASecondRasterOfTheSameGround) {
  const Surface tissue = wide_tissue();
  std::vector<Palpation> twice = rows(tissue, 0.003, Vec3(0.001, 0.001, 0.0));
  const std::size_t before = twice.size();
  for (const Palpation& one : rows(tissue, 0.003, Vec3(0.0025, 0.0025, 0.0))) twice.push_back(one);
  EXPECT_TRUE(is_felt_again(since(before), tissue, twice));
}

}  // namespace
}  // namespace palpation
