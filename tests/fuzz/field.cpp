// Fields of any doubles on small surfaces of every kind: level loops and regions.
#include <cmath>

#include "fuzz/target.h"
#include "palpation/base/error.h"
#include "palpation/boundary/level_set.h"

namespace palpation::fuzz {
namespace {

/// Rounding of the corners of a region: a few last places of the sheet's size, along its whole
/// boundary.
double tolerance(const Surface& surface) { return 1e-12 * surface.area(); }

void check_laws(const Surface& surface, const Field& field, double level) {
  const double area = superlevel_area(surface, field, level);
  expect(area >= 0.0 && area <= surface.area() + tolerance(surface),
         "a part is no larger than the whole");
  for (const LevelLoop& loop : level_loops(surface, field, level)) {
    expect(loop.points.size() >= 2 && loop.on_border.size() == loop.points.size(),
           "a loop goes somewhere");
    for (const SurfacePoint& point : loop.points)
      expect(surface.position(point).allFinite(), "a loop's points are places");
  }
  if (!surface.has_chart()) return;
  const Region region = superlevel_region(surface, field, level);
  expect(std::abs(region.area() - area) <= tolerance(surface),
         "a region has the area of its triangles");
}

}  // namespace
}  // namespace palpation::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace palpation;
  fuzz::Numbers numbers(bytes, size);
  const std::span<const Surface> surfaces = fuzz::surfaces();
  const Surface& surface = surfaces[numbers.byte() % surfaces.size()];
  const double level = numbers.real();
  Field field(surface.vertex_count());
  for (double& value : field) value = numbers.real();
  fuzz::check_laws(surface, field, level);
  return 0;
}
