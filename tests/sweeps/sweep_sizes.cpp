// What size does to level sets, regions and Booleans: boundaries of COUNT pieces, one by one, with
// the time that each takes and the peak of memory so far. Nothing may need a stack that grows with
// the boundary: run it under `ulimit -s 256`.
//
// usage: sweep_sizes COUNT SEED        a million pieces take a minute or two and some gigabytes
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "boundary/polygons.h"
#include "palpation/base/error.h"
#include "palpation/base/random.h"
#include "palpation/boundary/level_set.h"
#include "palpation/boundary/region_error.h"
#include "palpation/geometry/make_plane.h"

namespace palpation {
namespace {

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void say(const std::string& what, const Stopwatch& watch) {
  std::printf("%-72s %8.3f s, peak so far %6.0f MB\n", what.c_str(), watch.seconds(),
              peak_megabytes());
  std::fflush(stdout);
}

int failures = 0;

void check(bool holds, const std::string& what) {
  if (holds) return;
  std::printf("FAILED: %s\n", what.c_str());
  ++failures;
}

Surface square(int cells) {
  Random random(1);
  return Surface(make_plane(
      {.size_m = {1.0, 1.0}, .columns = cells + 1, .rows = cells + 1, .jitter = 0.2}, random));
}

std::size_t pieces(const std::vector<LevelLoop>& loops) {
  std::size_t sum = 0;
  for (const LevelLoop& loop : loops) sum += loop.points.size();
  return sum;
}

void level_set(const std::string& name, const Surface& surface, const Field& field) {
  const Stopwatch of_loops;
  const std::vector<LevelLoop> loops = level_loops(surface, field, 0.0);
  say(name + ": " + std::to_string(pieces(loops)) + " pieces in " + std::to_string(loops.size()) +
          " loops",
      of_loops);
  const Stopwatch of_region;
  const Region region = superlevel_region(surface, field, 0.0);
  say(name + ": its region of " + std::to_string(region.polygons().size()) + " polygons",
      of_region);
  const double area = superlevel_area(surface, field, 0.0);
  check(std::abs(region.area() - area) <= 1e-11,
        name + ": area " + text_of(region.area()) + ", by triangles " + text_of(area));
}

/// Three of four triangles are crossed by the level.
void rough_level_set(int count, Random& random) {
  const Surface surface = square(std::max(2, static_cast<int>(std::sqrt(count / 1.5))));
  Field field(surface.vertex_count());
  for (double& value : field) value = random.normal();
  level_set("rough field", surface, field);
}

/// Every second row of vertices is inside, joined to the next at alternate ends: one loop along all
/// of them.
void snake(int count) {
  const int cells = std::max(4, static_cast<int>(std::sqrt(count / 2)) / 2 * 2);
  const Surface surface = square(cells);
  Field field(surface.vertex_count());
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    const int row = vertex / (cells + 1);
    const int column = vertex % (cells + 1);
    const bool turn = column == (row % 4 == 1 ? cells - 1 : 1);
    const bool on_rim = row == 0 || column == 0 || row == cells || column == cells;
    field[vertex] = !on_rim && (row % 2 == 0 || turn) ? 1.0 : -1.0;
  }
  level_set("snake", surface, field);
}

void booleans(int corners, double roughness, int repeats, Random& random) {
  const std::string size =
      std::to_string(corners) + "-corner stars, roughness " + text_of(roughness);
  const Stopwatch of_regions;
  const Region a = testing::region_of(testing::star(random, {0.0, 0.0}, 1.0, corners, roughness));
  const Region b = testing::region_of(testing::star(random, {0.1, 0.05}, 1.0, corners, roughness));
  say(size + ": two regions made", of_regions);
  const Stopwatch of_difference;
  Region difference;
  for (int i = 0; i < repeats; ++i) difference = symmetric_difference(a, b);
  say(size + ": symmetric difference, " + std::to_string(repeats) + " times", of_difference);
  const Stopwatch of_areas;
  OverlapAreas areas;
  for (int i = 0; i < repeats; ++i) areas = overlap_areas(a, b);
  say(size + ": overlap areas, " + std::to_string(repeats) + " times", of_areas);
  check(std::abs(difference.area() - areas.only_a_m2 - areas.only_b_m2) <= 1e-14,
        size + ": two areas of the symmetric difference");
  const Surface tissue = square(2);
  const Stopwatch of_comparison;
  check(compare(tissue, a, b).hausdorff_m.has_value(), size + ": a distance");
  say(size + ": compared", of_comparison);
}

/// The crossings grow with the square of the spikes: refused before any work.
void spikes_across_spikes(int spikes) {
  const Stopwatch of_regions;
  const Region a = testing::region_of(testing::pinwheel(spikes, 1.0));
  const Region b = testing::region_of(testing::pinwheel(spikes, -1.0));
  say("two wheels of " + std::to_string(spikes) + " spikes made", of_regions);
  const Stopwatch watch;
  try {
    symmetric_difference(a, b);
    say("their symmetric difference", watch);
  } catch (const InvalidInput& error) {
    say("their symmetric difference refused", watch);
  }
}

int sweep(int count, std::uint64_t seed) {
  Random random(seed);
  rough_level_set(count, random);
  snake(count);
  booleans(500, 0.05, count < 100'000 ? 2 : 20, random);
  booleans(count / 10, 10.0 / count, 1, random);
  booleans(count, 1.0 / count, 1, random);
  spikes_across_spikes(std::max(100, count / 100));  // fewer would cross their own neighbours
  return failures;
}

}  // namespace
}  // namespace palpation

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: sweep_sizes COUNT SEED\n", stderr);
    return 2;
  }
  return palpation::sweep(std::atoi(argv[1]), std::strtoull(argv[2], nullptr, 10)) == 0 ? 0 : 1;
}
