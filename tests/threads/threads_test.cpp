// Values shared between threads: what is promised to be a regular value must not mind who else
// holds a copy. The assertions compare with one thread's answer; ThreadSanitizer looks for the
// races (tests/run --threads).
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "palpation/palpation.h"

namespace palpation {
namespace {

constexpr int kThreads = 4;

/// Runs the work in several threads at once, each with its number.
template <typename Work>
void in_threads(Work work) {
  std::vector<std::jthread> threads;
  for (int i = 0; i < kThreads; ++i) threads.emplace_back([i, &work] { work(i); });
}

TriangleMesh jittered_plane() {
  Random random(1);
  return make_plane({.size_m = {0.02, 0.03}, .columns = 21, .rows = 31, .jitter = 0.3}, random);
}

Ring star(const Vec2& centre, int corners) {
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    ring.push_back(centre + (i % 2 == 0 ? 1.0 : 0.6) * Vec2(std::cos(angle), std::sin(angle)));
  }
  return ring;
}

Region region_of(const Ring& ring) {
  const std::array polygon{PolygonWithHoles{ring, {}}};
  return Region(polygon);
}

TEST(Threads, AskOneSurfaceForWhatItComputesLazily) {
  const Surface surface(jittered_plane());
  const Surface other(jittered_plane());
  std::array<Vec3, kThreads> places;
  std::array<double, kThreads> areas{};
  in_threads([&](int i) {
    const Surface copy = surface;
    places[i] = copy.position(copy.project(Vec3(0.0071, 0.0123, 0.004)));
    areas[i] =
        copy.vertex_areas().sum() + copy.vertex_normals().col(2).sum() + copy.chart().uv.sum();
  });
  for (int i = 0; i < kThreads; ++i) {
    EXPECT_EQ(places[i], other.position(other.project(Vec3(0.0071, 0.0123, 0.004))));
    EXPECT_EQ(areas[i], areas[0]);
  }
}

TEST(Threads, GrowCopiesOfOneBeliefEachItsOwnWay) {
  const Surface surface(jittered_plane());
  const Belief shared =
      Belief(Prior(surface, Metric::Chart, {.length_m = 0.004}), {.noise_sd = 0.1})
          .condition_on(
              std::vector<Palpation>{{surface.at_vertex(5), 7.0}, {surface.at_vertex(300), 9.0}});
  const auto suppose = [&](int i) {
    return shared.condition_on(std::vector<Palpation>{{surface.at_vertex(100 + i), 8.0},
                                                      {surface.at_vertex(400 - i), 7.5}});
  };
  std::array<Marginals, kThreads> found;
  in_threads([&](int i) { found[i] = suppose(i).at_vertices(); });
  for (int i = 0; i < kThreads; ++i) {
    const Marginals alone = suppose(i).at_vertices();
    EXPECT_EQ(found[i].mean, alone.mean);
    EXPECT_EQ(found[i].variance, alone.variance);
  }
}

TEST(Threads, CombineRegionsThatTheyShare) {
  const Region one = region_of(star({0.0, 0.0}, 60));
  const Region cut = intersect(
      one, region_of(star({0.3, 0.1}, 50)));  // corners that are no doubles, shared by all
  std::array<double, kThreads> areas{};
  in_threads([&](int i) {
    Region mine = cut;
    for (int step = 0; step < 5; ++step)
      mine = symmetric_difference(mine, region_of(star({0.1 * (i + 1), 0.05 * step}, 40)));
    areas[i] = mine.area() + overlap_areas(cut, one).both_m2 + (Region().empty() ? 0.0 : 1.0);
  });
  for (int i = 0; i < kThreads; ++i) {
    Region mine = cut;
    for (int step = 0; step < 5; ++step)
      mine = symmetric_difference(mine, region_of(star({0.1 * (i + 1), 0.05 * step}, 40)));
    EXPECT_EQ(areas[i], mine.area() + overlap_areas(cut, one).both_m2);
  }
}

TEST(Threads, DrawLevelSetsOfOneSurface) {
  const Surface surface(jittered_plane());
  Field field(surface.vertex_count());
  for (int vertex = 0; vertex < field.size(); ++vertex)
    field[vertex] = std::sin(700.0 * surface.vertex(vertex).x());
  std::array<double, kThreads> areas{};
  in_threads([&](int i) { areas[i] = superlevel_region(surface, field, 0.1).area(); });
  for (int i = 1; i < kThreads; ++i) EXPECT_EQ(areas[i], areas[0]);
}

TEST(Threads, ExploreSideBySide) {
  const Surface surface(jittered_plane());
  const Phantom phantom(surface, {Disk{Vec3(0.010, 0.015, 0.0), 0.005}}, {.noise = 0.02});
  std::array<double, kThreads> levels{};
  in_threads([&](int i) {
    Exploration exploration(surface, {}, {.batches = 2});
    Random random(1);
    run(
        exploration,
        [&](const SurfacePoint& where, const Vec3&) {
          return std::optional(phantom.touch(where, random));
        },
        {}, 0.001);
    levels[i] = exploration.conclusion().level ? exploration.conclusion().level->value : 0.0;
  });
  for (int i = 1; i < kThreads; ++i) EXPECT_EQ(levels[i], levels[0]);
}

// VTK and CGAL keep handlers of errors once a process.
TEST(Threads, ReadBadAndGoodFilesAtOnce) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("palpation-threads-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  write_mesh(folder / "plane.ply", jittered_plane(), LengthUnit::Millimetre);
  write_atomically(folder / "bad.vtp",
                   "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"3\" "
                   "NumberOfPolys=\"1\"></Piece>");
  std::array<int, kThreads> sound{};
  in_threads([&](int i) {
    for (int turn = 0; turn < 5; ++turn) {
      sound[i] +=
          read_mesh(folder / "plane.ply", LengthUnit::Millimetre).mesh.vertices.rows() == 651 ? 1
                                                                                              : 0;
      try {
        read_mesh(folder / "bad.vtp", LengthUnit::Millimetre);
      } catch (const IoError&) {
        sound[i] += 1;
      }
    }
  });
  for (int i = 0; i < kThreads; ++i) EXPECT_EQ(sound[i], 10);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace palpation
