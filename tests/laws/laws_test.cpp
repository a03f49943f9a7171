// What must hold of the whole, whatever the tissue: the answer does not depend on where the tissue
// lies, on its scale, on the numbers of its vertices, on the order of readings, or on how many
// threads work.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "geometry/zoo.h"
#include "palpation/palpation.h"

namespace palpation {
namespace {

TriangleMesh jittered_mesh() {
  Random random(11);
  return make_plane({.columns = 41, .rows = 81, .jitter = 0.35}, random);
}

struct Result {
  std::vector<Vec3> stops;  // every place touched, in order
  double area = 0.0;
  double error = 0.0;
};

/// The whole loop with everything fixed that is not under test. `scale` multiplies all lengths of
/// the model; `back` maps places to the unmoved tissue.
Result explored(const TriangleMesh& mesh, double scale = 1.0,
                const Eigen::Isometry3d& back = Eigen::Isometry3d::Identity()) {
  const Surface tissue(mesh);
  const Vec3 centre = back.inverse() * Vec3(0.0115, 0.030, 0.0) * scale;
  const Phantom phantom(tissue, {Disk{centre, 0.00625 * scale}}, {.slope_per_m = 1400.0 / scale});
  FieldModel field;
  field.metric = Metric::Ambient;
  field.kernel.length_m = 0.0033 * scale;
  field.kernel.signal_sd = 1.0;
  field.noise.sd = 0.1;
  Exploration exploration(tissue, {.field = field, .level = {.known = 8.0}},
                          {.acquisition = straddle(),
                           .initial = {.count = 0},
                           .batch = {.least_spacing_m = 0.0005 * scale},
                           .batches = 4});

  // The first touches are at the same places of the tissue, wherever it lies.
  Random unused(0);
  std::vector<Palpation> first;
  for (const Vec3& place :
       {Vec3(0.005, 0.010, 0.0), Vec3(0.020, 0.012, 0.0), Vec3(0.012, 0.030, 0.0),
        Vec3(0.006, 0.043, 0.0), Vec3(0.019, 0.040, 0.0)}) {
    first.push_back(phantom.touch(
        tissue.at_vertex(tissue.nearest_vertex(back.inverse() * place * scale)), unused));
  }
  exploration.take_up(first);
  Result result;
  run(exploration, [&](const SurfacePoint& where, const Vec3&) {
    result.stops.push_back(back * (tissue.position(where) / scale));
    return std::optional(phantom.touch(where, unused));
  });
  const Region found = superlevel_region(tissue, exploration.conclusion().marginals.mean, 8.0);
  result.area = found.area() / (scale * scale);
  result.error = compare(tissue, found, superlevel_region(tissue, phantom.truth(), 8.0))
                     .symmetric_difference_m2 /
                 (scale * scale);
  return result;
}

void expect_same(const Result& a, const Result& b) {
  ASSERT_EQ(a.stops.size(), b.stops.size());
  for (std::size_t i = 0; i < a.stops.size(); ++i)
    EXPECT_NEAR((a.stops[i] - b.stops[i]).norm(), 0.0, 1e-9) << "touch " << i;
  // 125 mm2 of tumour: one part in 1e9.
  EXPECT_NEAR(a.area, b.area, 1e-13);
  EXPECT_NEAR(a.error, b.error, 1e-13);
}

TEST(Laws, RigidMotionOfTheTissueMovesTheAnswerWithIt) {
  const TriangleMesh mesh = jittered_mesh();
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.rotate(Eigen::AngleAxisd(0.9, Vec3(1.0, -2.0, 0.5).normalized()));
  motion.pretranslate(Vec3(0.2, -0.1, 0.05));
  expect_same(explored(mesh), explored(zoo::moved(mesh, motion.linear(), motion.translation()), 1.0,
                                       motion.inverse()));
}

TEST(Laws, ScalingTheTissueAndAllLengthsScalesTheAnswer) {
  const TriangleMesh mesh = jittered_mesh();
  for (const double scale : {1e-3, 1e3}) {
    TriangleMesh scaled = mesh;
    scaled.vertices *= scale;
    expect_same(explored(mesh), explored(scaled, scale));
  }
}

TEST(Laws, RelabelledVerticesAndFacesGiveTheSameAnswer) {
  const TriangleMesh mesh = jittered_mesh();
  Random random(5);
  const TriangleMesh renumbered =
      zoo::relabelled(mesh, zoo::shuffled(static_cast<int>(mesh.vertices.rows()), random));
  expect_same(explored(mesh), explored(zoo::reordered(renumbered, random)));
}

TEST(Laws, ThreadsDoNotChangeABit) {
  const TriangleMesh mesh = jittered_mesh();
  set_thread_count(1);
  const Result one = explored(mesh);
  set_thread_count(2);
  const Result two = explored(mesh);
  EXPECT_EQ(one.area, two.area);
  EXPECT_EQ(one.error, two.error);
  for (std::size_t i = 0; i < one.stops.size(); ++i) EXPECT_EQ(one.stops[i], two.stops[i]);
}

TEST(Laws, AFieldThatIsLinearlyInterpolatedHasTheSameRegionOnSplitFaces) {
  const TriangleMesh mesh = jittered_mesh();
  const Surface coarse(mesh);
  const Surface fine(refine(mesh, 0.9 * 0.0006));
  ASSERT_GT(fine.face_count(), coarse.face_count());
  const Phantom phantom(coarse, {Disk{Vec3(0.0115, 0.030, 0.0), 0.00625}}, {});
  Field on_fine(fine.vertex_count());
  for (int vertex = 0; vertex < fine.vertex_count(); ++vertex)
    on_fine[vertex] = coarse.interpolate(phantom.truth(), coarse.project(fine.vertex(vertex)));
  // 123 mm2; the projection is good to 1e-15 m over an outline of 39 mm.
  EXPECT_NEAR(superlevel_region(coarse, phantom.truth(), 8.0).area(),
              superlevel_region(fine, on_fine, 8.0).area(), 1e-13);
}

TEST(Laws, ThePlanarSceneComputesNothingItDoesNotNeed) {
  const Surface tissue(jittered_mesh());
  const Phantom phantom(tissue, {Disk{Vec3(0.0115, 0.030, 0.0), 0.00625}}, {.noise = 0.05});
  Exploration exploration(tissue, {}, {.batches = 2});
  Random random(1);
  run(
      exploration,
      [&](const SurfacePoint& where, const Vec3&) {
        return std::optional(phantom.touch(where, random));
      },
      {}, 0.001);
  const Region found = superlevel_region(tissue, exploration.conclusion().marginals.mean,
                                         exploration.conclusion().level->value);
  compare(tissue, found, superlevel_region(tissue, phantom.truth(), 8.0));
  EXPECT_TRUE(tissue.computed().empty());
}

}  // namespace
}  // namespace palpation
