#include "geometry/unfolding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geometry/geodesics.h"
#include "geometry/zoo.h"
#include "palpation/geometry/make_phantom.h"
#include "palpation/geometry/sampling.h"

namespace palpation {
namespace {

Surface phantom(const Sheet& sheet, double edge_m, std::uint64_t seed = 1) {
  Random random(seed);
  return Surface(make_phantom(sheet, edge_m, 0.3, random).mesh);
}

struct Named {
  const char* name;
  Surface surface;
};

std::vector<Named> curved_surfaces() {
  return {{"cylinder", phantom(cylinder_sheet(), 0.0015)},
          {"dome", phantom(dome_sheet(), 0.0015)},
          {"saddle", phantom(saddle_sheet(), 0.0015)},
          {"wave", phantom(wave_sheet({.amplitude_m = 0.004}), 0.0015)},
          {"folded", phantom(folded_sheet({.gap_m = 0.003}), 0.0015)}};
}

double greatest_difference(const Field& a, const Field& b) { return (a - b).cwiseAbs().maxCoeff(); }

TEST(Unfolding, AgreesWithItsTwinOnCurvedTissue) {
  for (const auto& [name, surface] : curved_surfaces()) {
    Random random(3);
    std::vector<SurfacePoint> sources = sample_uniformly(surface, 3, random);
    sources.push_back(surface.at_vertex(surface.vertex_count() / 2));
    for (const SurfacePoint& source : sources) {
      const std::span<const SurfacePoint> one(&source, 1);
      // Rounding along some hundred unfoldings of 1e-3 m.
      EXPECT_LT(greatest_difference(unfolded_distances(surface, one),
                                    unfold_distances(surface.mesh(), one)),
                1e-12)
          << name;
    }
    EXPECT_LT(greatest_difference(unfolded_distances(surface, sources),
                                  unfold_distances(surface.mesh(), sources)),
              1e-12)
        << name;
  }
}

TEST(Unfolding, AgreesWithItsTwinOnRegularMeshesWhereLightMeetsCornersExactly) {
  for (const TriangleMesh& mesh : {zoo::cylinder_mesh(1.0, 2.0, 16, 10), zoo::unit_square_mesh(8),
                                   zoo::cylinder_mesh(1.0, 2.0, 5, 3)}) {
    const Surface surface(mesh);
    for (int vertex = 0; vertex < surface.vertex_count(); vertex += 7) {
      const SurfacePoint source = surface.at_vertex(vertex);
      const std::span<const SurfacePoint> one(&source, 1);
      EXPECT_LT(greatest_difference(unfolded_distances(surface, one),
                                    unfold_distances(surface.mesh(), one)),
                1e-13);
    }
  }
}

TEST(Unfolding, StopsAtTheRadius) {
  const Surface dome = phantom(dome_sheet(), 0.001);
  const SurfacePoint source = dome.at_vertex(0);
  const Field all = unfolded_distances(dome, std::span(&source, 1)),
              near = unfolded_distances(dome, std::span(&source, 1), {.radius_m = 0.008});
  for (int v = 0; v < dome.vertex_count(); ++v) {
    if (all[v] <= 0.008)
      EXPECT_EQ(near[v], all[v]);
    else
      EXPECT_EQ(near[v], std::numeric_limits<double>::infinity());
  }
}

double length_of(const Surface& surface, const std::vector<Piece>& pieces) {
  double length = 0.0;
  for (const Piece& piece : pieces)
    length +=
        (surface.position({piece.face, piece.to}) - surface.position({piece.face, piece.from}))
            .norm();
  return length;
}

TEST(Unfolding, FindsAPathThatHangsTogetherAndIsAsLongAsTheDistance) {
  for (const auto& [name, surface] : curved_surfaces()) {
    Random random(5);
    for (int k = 0; k < 20; ++k) {
      const std::vector<SurfacePoint> ends = sample_uniformly(surface, 2, random);
      SurfacePoint from = ends[0], to = ends[1];
      if (k % 4 == 1) from = surface.at_vertex(random.below(surface.vertex_count()));
      if (k % 4 >= 2) to = surface.at_vertex(random.below(surface.vertex_count()));
      if (k % 4 == 3) from.barycentric = Vec3(0.25, 0.75, 0.0);
      const auto path = unfolded_path(surface, from, to);
      ASSERT_TRUE(path) << name;
      ASSERT_FALSE(path->pieces.empty()) << name;
      EXPECT_NEAR(length_of(surface, path->pieces), path->length_m, 1e-12) << name;
      EXPECT_NEAR((surface.position({path->pieces.front().face, path->pieces.front().from}) -
                   surface.position(from))
                      .norm(),
                  0.0, 1e-15);
      EXPECT_NEAR((surface.position({path->pieces.back().face, path->pieces.back().to}) -
                   surface.position(to))
                      .norm(),
                  0.0, 1e-15);
      for (std::size_t p = 1; p < path->pieces.size(); ++p) {
        const Vec3 end = surface.position({path->pieces[p - 1].face, path->pieces[p - 1].to});
        EXPECT_NEAR((surface.position({path->pieces[p].face, path->pieces[p].from}) - end).norm(),
                    0.0, 1e-15)
            << name;
      }
      const Field distance = unfolded_distances(surface, std::span(&from, 1));
      if (k % 4 >= 2) {
        int vertex = 0;
        for (int corner = 0; corner < 3; ++corner) {
          if (to.barycentric[corner] == 1.0) vertex = surface.triangle(to.face)[corner];
        }
        EXPECT_NEAR(path->length_m, distance[vertex], 1e-12) << name;
      }
      EXPECT_TRUE(unfolded_path(surface, from, to, path->length_m)) << name;
      EXPECT_FALSE(unfolded_path(surface, from, to, 0.99 * path->length_m)) << name;
    }
  }
}

}  // namespace
}  // namespace palpation
