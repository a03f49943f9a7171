#include "geometry/settled_point.h"

#include <gtest/gtest.h>

#include "palpation/base/random.h"
#include "palpation/geometry/make_phantom.h"
#include "palpation/geometry/sampling.h"

namespace palpation {
namespace {

// A file keeps positions alone. Inside faces, on edges and at vertices of curved tissue.
TEST(SettledPoint, ComesBackFromItsPosition) {
  Random random(1);
  const Surface tissue(make_phantom(wave_sheet(), 0.002, 0.3, random).mesh);
  for (int trial = 0; trial < 2000; ++trial) {
    SurfacePoint point{static_cast<int>(random.uniform() * tissue.face_count()),
                       Vec3(random.uniform(), random.uniform(), random.uniform())};
    if (trial % 3 > 0) point.barycentric[trial % 2] = 0.0;
    if (trial % 3 > 1) point.barycentric[2] = 0.0;
    point.barycentric /= point.barycentric.sum();
    const SurfacePoint settled = settled_point(tissue, point);
    EXPECT_LT((tissue.position(settled) - tissue.position(point)).norm(), 1e-11);
    const SurfacePoint back = settled_point(tissue, tissue.project(tissue.position(settled)));
    EXPECT_EQ(back.face, settled.face);
    EXPECT_TRUE(back.barycentric == settled.barycentric);
  }
}

}  // namespace
}  // namespace palpation
