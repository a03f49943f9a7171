#include "exploration/coarse_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "belief/tissue.h"
#include "palpation/base/error.h"
#include "palpation/boundary/level_set.h"
#include "palpation/boundary/region_error.h"
#include "palpation/world/phantom.h"

namespace palpation {
namespace {

struct Felt {
  std::vector<Palpation> palpations;
  std::vector<int> vertices;  ///< touched, of the fine tissue
};

Phantom disk_phantom(const Surface& tissue) {
  return Phantom(tissue, {Disk{Vec3(0.0115, 0.030, 0.0), 0.00625}}, {.noise = 0.05});
}

Felt felt_with(const CoarseMesh& coarse, const Surface& tissue, const Phantom& phantom,
               double way_step_m = 0.0) {
  Random random(1);
  Felt felt;
  Exploration planner(Surface(coarse.mesh), {}, {.batches = 5});
  felt.palpations = run_coarsely(
      planner, coarse, tissue,
      [&](const SurfacePoint& where, const Vec3&) {
        for (int corner = 0; corner < 3; ++corner) {
          if (where.barycentric[corner] == 1.0)
            felt.vertices.push_back(tissue.triangle(where.face)[corner]);
        }
        return std::optional(phantom.touch(where, random));
      },
      {}, way_step_m);
  return felt;
}

TEST(CoarseRun, OnTheWholeMeshIsTheRun) {
  const Surface tissue = plane(26, 51);
  const Phantom phantom = disk_phantom(tissue);
  CoarseMesh whole{tissue.mesh(),
                   std::vector<int>(static_cast<std::size_t>(tissue.vertex_count()))};
  std::iota(whole.vertices.begin(), whole.vertices.end(), 0);
  const Felt felt = felt_with(whole, tissue, phantom);

  Exploration exploration(tissue, {}, {.batches = 5});
  Random random(1);
  run(exploration, [&](const SurfacePoint& where, const Vec3&) {
    return std::optional(phantom.touch(where, random));
  });
  ASSERT_EQ(felt.palpations.size(), exploration.conclusion().palpations.size());
  for (std::size_t i = 0; i < felt.palpations.size(); ++i) {
    EXPECT_EQ(felt.palpations[i].reading, exploration.conclusion().palpations[i].reading);
    EXPECT_EQ(felt.palpations[i].batch, exploration.conclusion().palpations[i].batch);
  }
}

TEST(CoarseRun, TouchesVerticesThatBothMeshesHave) {
  const Surface tissue = plane(51, 101);
  const Phantom phantom = disk_phantom(tissue);
  const CoarseMesh coarse = coarsen(tissue, 0.0015);
  const Felt felt = felt_with(coarse, tissue, phantom);
  EXPECT_EQ(felt.palpations.size(), 66u);
  for (const int vertex : felt.vertices)
    EXPECT_TRUE(std::binary_search(coarse.vertices.begin(), coarse.vertices.end(), vertex));
}

TEST(CoarseRun, TakesReadingsOnTheWay) {
  const Surface tissue = plane(26, 51);
  const Phantom phantom = disk_phantom(tissue);
  const Felt stops = felt_with(coarsen(tissue, 0.0015), tissue, phantom);
  const Felt ways = felt_with(coarsen(tissue, 0.0015), tissue, phantom, 0.001);
  EXPECT_GT(ways.palpations.size(), 3 * stops.palpations.size());
}

/// The bound that is stated for plans on a coarser mesh: concluded on the whole one, the boundary
/// is as good.
TEST(CoarseRun, EndsWithABoundaryAsGoodAsThatOfThePlanOnTheWholeMesh) {
  const Surface tissue = plane(101, 201);
  const Phantom phantom = disk_phantom(tissue);
  const Region truth = superlevel_region(tissue, phantom.truth(), phantom.true_level());
  for (const double explore_m : {0.0005, 0.001, 0.002}) {
    Exploration concluded(tissue, {}, {.initial = {.count = 0}, .batches = 0});
    concluded.take_up(felt_with(coarsen(tissue, explore_m), tissue, phantom).palpations);
    ASSERT_TRUE(concluded.conclusion().level);
    const Contour& contour = *concluded.conclusion().contour;
    const RegionError error =
        compare(tissue, superlevel_region(tissue, contour.field, contour.level), truth);
    EXPECT_LT(error.symmetric_difference_m2, 8e-6)
        << "of a disk of 123 mm2, planned at " << explore_m;
    EXPECT_GT(error.dice, 0.96);
  }
}

TEST(CoarseRun, RefusesAPlannerOfAnotherTissue) {
  const Surface tissue = plane(26, 51);
  Exploration planner(tissue);
  const Probe nothing = [](const SurfacePoint&, const Vec3&) { return std::optional<Palpation>(); };
  EXPECT_THROW(run_coarsely(planner, coarsen(tissue, 0.003), tissue, nothing), InvalidInput);
}

TEST(CoarseRun, KnowsWhichVerticesOfThePlanCanBeTouched) {
  const CoarseMesh coarse{{}, {2, 5, 7, 11}};
  EXPECT_EQ(on_coarse(coarse, std::vector<int>{1, 5, 6, 11, 12}), (std::vector<int>{1, 3}));
}

}  // namespace
}  // namespace palpation
