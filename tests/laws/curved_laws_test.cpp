// What must hold on tissue that is not flat: bending it without stretch changes nothing, and
// neither does splitting its triangles.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/zoo.h"
#include "palpation/palpation.h"

namespace palpation {
namespace {

/// A sheet of 26 x 50 mm of flat facets, uneven, bent around 15 mm; and the plane that it unrolls
/// to.
struct Sheets {
  TriangleMesh bent, flat;
};
Sheets sheets() {
  constexpr int kColumns = 26, kRows = 46;
  constexpr double kRadius = 0.015, kLength = 0.050;
  Random random(7);
  std::vector<double> angle = {0.0}, across = {0.0}, jitter;
  for (int c = 1; c <= kColumns; ++c) {
    angle.push_back(angle.back() + (0.6 + 0.8 * random.uniform()) * 1.75 / kColumns);
    across.push_back(across.back() + 2.0 * kRadius * std::sin(0.5 * (angle[c] - angle[c - 1])));
  }
  // Vertices move along the lines between facets, but for those at the ends.
  for (int i = 0; i < (kColumns + 1) * (kRows + 1); ++i)
    jitter.push_back(0.6 * (random.uniform() - 0.5) * kLength / kRows);
  const auto grid = [&](const auto& place) {
    return zoo::rolled_grid_mesh(kColumns, kRows, false, false, [&](double u, double v) {
      const int c = static_cast<int>(std::lround(u * kColumns)),
                r = static_cast<int>(std::lround(v * kRows));
      return place(c, kLength * v + (r == 0 || r == kRows ? 0.0 : jitter[r * (kColumns + 1) + c]));
    });
  };
  return {grid([&](int c, double y) {
            return Vec3(-kRadius * std::cos(angle[c]), y, kRadius * std::sin(angle[c]));
          }),
          grid([&](int c, double y) { return Vec3(across[c], y, 0.0); })};
}

struct Result {
  std::vector<SurfacePoint> picks;
  double area = 0.0, truth = 0.0;
  RegionError error;
};

/// The whole loop in the chart's metric; places are told by vertices, which have the same numbers
/// on both.
Result explored(const TriangleMesh& mesh, int centre) {
  const Surface tissue(mesh);
  const Phantom phantom(tissue, {Disk{tissue.vertex(centre), 0.00625}}, {.slope_per_m = 1400.0});
  FieldModel field;
  field.metric = Metric::Chart;
  field.kernel = {.length_m = 0.0033, .signal_sd = 1.0};
  field.noise.sd = 0.1;
  Exploration exploration(tissue, {.field = field, .level = {.known = 8.0}},
                          {.acquisition = straddle(),
                           .initial = {.count = 0},
                           .batch = {.least_spacing_m = 0.0005},
                           .batches = 5});
  Random unused(0);
  std::vector<Palpation> first;
  for (const int vertex : {100, 333, 555, 640, 700, 901, 1100})
    first.push_back(phantom.touch(tissue.at_vertex(vertex), unused));
  exploration.take_up(first);
  Result result;
  run(exploration, [&](const SurfacePoint& where, const Vec3&) {
    result.picks.push_back(where);
    return std::optional(phantom.touch(where, unused));
  });
  const Region found = superlevel_region(tissue, exploration.conclusion().marginals.mean, 8.0);
  const Region truth = superlevel_region(tissue, phantom.truth(), 8.0);
  result.area = surface_area(tissue, found);
  result.truth = surface_area(tissue, truth);
  result.error = compare(tissue, found, truth);
  return result;
}

TEST(CurvedLaws, AFacetedCylinderIsThePlaneThatItUnrollsTo) {
  const Sheets tissue = sheets();
  const Result bent = explored(tissue.bent, 640), flat = explored(tissue.flat, 640);
  ASSERT_EQ(bent.picks.size(), flat.picks.size());
  ASSERT_GE(flat.picks.size(), 40u);
  for (std::size_t i = 0; i < flat.picks.size(); ++i) {
    EXPECT_EQ(bent.picks[i].face, flat.picks[i].face) << "touch " << i;
    EXPECT_LT((bent.picks[i].barycentric - flat.picks[i].barycentric).norm(), 1e-9)
        << "touch " << i;
  }
  ASSERT_GT(flat.truth, 100e-6);
  EXPECT_NEAR(bent.truth / flat.truth, 1.0, 1e-9);  // the aim; 1e-6 is asked for
  EXPECT_NEAR(bent.area / flat.area, 1.0, 1e-9);
  EXPECT_NEAR(bent.error.symmetric_difference_m2, flat.error.symmetric_difference_m2,
              1e-9 * flat.area);
  EXPECT_NEAR(*bent.error.hausdorff_m, *flat.error.hausdorff_m, 1e-9 * 0.05);
  EXPECT_NEAR(*bent.error.mean_distance_m, *flat.error.mean_distance_m, 1e-9 * 0.05);
}

/// Every triangle in three, around a place inside it; the field goes on linearly.
struct Split {
  TriangleMesh mesh;
  Field a, b;
};
Split split(const TriangleMesh& mesh, const Field& a, const Field& b) {
  const Eigen::Index n = mesh.vertices.rows(), m = mesh.triangles.rows();
  Split finer{{Points(n + m, 3), Triangles(3 * m, 3)}, Field(n + m), Field(n + m)};
  finer.mesh.vertices.topRows(n) = mesh.vertices;
  finer.a.head(n) = a;
  finer.b.head(n) = b;
  Random random(4);
  for (Eigen::Index f = 0; f < m; ++f) {
    const Eigen::Vector3i t = mesh.triangles.row(f);
    Vec3 weight(0.2 + random.uniform(), 0.2 + random.uniform(), 0.2 + random.uniform());
    weight /= weight.sum();
    finer.mesh.vertices.row(n + f).setZero();
    finer.a[n + f] = finer.b[n + f] = 0.0;
    for (int i = 0; i < 3; ++i) {
      finer.mesh.vertices.row(n + f) += weight[i] * mesh.vertices.row(t[i]);
      finer.a[n + f] += weight[i] * a[t[i]];
      finer.b[n + f] += weight[i] * b[t[i]];
      finer.mesh.triangles.row(3 * f + i) << t[i], t[(i + 1) % 3], static_cast<int>(n + f);
    }
  }
  return finer;
}

// The finer mesh has a chart of its own; areas are those on the tissue.
TEST(CurvedLaws, SplittingFacesLeavesAreasAndErrors) {
  TriangleMesh mesh = zoo::jittered_square_mesh(20, 2);
  for (auto vertex : mesh.vertices.rowwise())
    vertex.z() = 0.8 * (vertex.x() - 0.5) * (vertex.y() - 0.4) + 0.3 * vertex.x() * vertex.x();
  const Surface coarse(mesh);
  Field a(coarse.vertex_count()), b(coarse.vertex_count());
  for (int v = 0; v < coarse.vertex_count(); ++v) {
    a[v] = 0.3 - (coarse.vertex(v).head<2>() - Vec2(0.5, 0.5)).norm();
    b[v] = 0.25 - (coarse.vertex(v).head<2>() - Vec2(0.55, 0.45)).norm();
  }
  const Split finer = split(mesh, a, b);
  const Surface fine(finer.mesh);
  ASSERT_FALSE(coarse.chart().isometric);
  const double area = surface_area(coarse, superlevel_region(coarse, a, 0.0));
  EXPECT_NEAR(surface_area(fine, superlevel_region(fine, finer.a, 0.0)) / area, 1.0, 1e-9);
  const RegionError before =
      compare(coarse, superlevel_region(coarse, a, 0.0), superlevel_region(coarse, b, 0.0));
  const RegionError after =
      compare(fine, superlevel_region(fine, finer.a, 0.0), superlevel_region(fine, finer.b, 0.0));
  EXPECT_NEAR(after.missed_m2, before.missed_m2, 1e-9 * area);
  EXPECT_NEAR(after.extra_m2, before.extra_m2, 1e-9 * area);
  EXPECT_NEAR(after.dice, before.dice, 1e-9);
  EXPECT_NEAR(*after.mean_distance_m / *before.mean_distance_m, 1.0, 1e-2)
      << "measured along straight lines of two charts";
}

}  // namespace
}  // namespace palpation
