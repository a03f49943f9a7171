// Regions: exact Booleans, areas, and how wrong one outline is against another.
// Usage: 06_regions
#include <cstdio>

#include "palpation/palpation.h"

using namespace palpation;

namespace {

Region rectangle(double left, double bottom, double right, double top) {
  const PolygonWithHoles polygon{
      {Vec2(left, bottom), Vec2(right, bottom), Vec2(right, top), Vec2(left, top)}, {}};
  return Region(std::span(&polygon, 1));
}

}  // namespace

int main() {
  const Region cut = rectangle(0.004, 0.010, 0.012, 0.020);
  const Region tumour = rectangle(0.006, 0.012, 0.014, 0.022);
  std::printf("cut %.0f mm2, tumour %.0f mm2, both %.0f mm2, either %.0f mm2\n", cut.area() * 1e6,
              tumour.area() * 1e6, intersect(cut, tumour).area() * 1e6,
              unite(cut, tumour).area() * 1e6);

  Random random(1);
  const Surface tissue(make_plane({.columns = 26, .rows = 51}, random));
  const RegionError error = compare(tissue, cut, tumour);
  std::printf("missed %.0f mm2, extra %.0f mm2, Dice %.3f, at most %.2f mm apart\n",
              error.missed_m2 * 1e6, error.extra_m2 * 1e6, error.dice, *error.hausdorff_m * 1e3);

  const Region ring =
      subtract(rectangle(0.0, 0.0, 0.010, 0.010), rectangle(0.003, 0.003, 0.007, 0.007));
  std::printf("a ring has %zu polygon with %zu hole and %.0f mm2\n", ring.polygons().size(),
              ring.polygons().front().holes.size(), ring.area() * 1e6);
}
