// The laws of Booleans on COUNT random pairs of regions: outlines on a lattice, where everything
// coincides, the same with noise in the last digits, stars, and stars turned by next to nothing.
// Regions are compared by their symmetric difference, which is exact. Ends with 1 if a law is
// broken.
//
// usage: sweep_booleans COUNT SEED          100,000 pairs take half an hour
//        sweep_booleans --areas PAIRS       what this library says of the pairs in a file: see
//        compare_with_shapely.py beside
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

#include "boundary/polygons.h"

namespace palpation {
namespace {

using testing::lattice_ring;
using testing::star;

Ring disturbed(Ring ring, double noise, Random& random) {
  for (Vec2& corner : ring) corner += noise * Vec2(random.normal(), random.normal());
  return ring;
}

Ring turned(Ring ring, double angle) {
  for (Vec2& corner : ring)
    corner = Vec2(corner.x() - angle * corner.y(), corner.y() + angle * corner.x());
  return ring;
}

std::pair<Region, Region> random_pair(Random& random) {
  const auto on_lattice = [&](double noise) {
    return Region::even_odd(
        std::vector<Ring>{disturbed(lattice_ring(random, 3 + random.below(6), 7), noise, random),
                          disturbed(lattice_ring(random, 4, 7), noise, random)});
  };
  const double next_to_nothing = std::pow(10.0, -8.0 - 9.0 * random.uniform());
  switch (random.below(4)) {
    case 0:
      return {on_lattice(0.0), on_lattice(0.0)};
    case 1:
      return {on_lattice(0.0), on_lattice(next_to_nothing)};
    case 2: {
      const Vec2 centre(random.uniform(), random.uniform());
      return {testing::region_of(star(random, {0.0, 0.0}, 1.0, 5 + random.below(20))),
              testing::region_of(star(random, centre, 1.0, 5 + random.below(20)))};
    }
    default: {
      const Ring ring = star(random, {0.0, 0.0}, 1.0, 5 + random.below(20));
      return {testing::region_of(ring), testing::region_of(turned(ring, next_to_nothing))};
    }
  }
}

/// The first law that a pair breaks, or nothing.
std::string broken_law(const Region& a, const Region& b) {
  using testing::same;
  const Region both = intersect(a, b);
  const Region either = unite(a, b);
  const Region difference = symmetric_difference(a, b);
  const Region only_a = subtract(a, b);
  const Region only_b = subtract(b, a);
  if (!same(difference, unite(only_a, only_b))) return "A ^ B is (A - B) | (B - A)";
  if (!same(difference, subtract(either, both))) return "A ^ B is (A | B) - (A & B)";
  if (!same(a, unite(only_a, both))) return "A is (A - B) | (A & B)";
  if (!intersect(only_a, b).empty()) return "(A - B) & B is nothing";
  if (!same(symmetric_difference(difference, b), a)) return "(A ^ B) ^ B is A";
  if (!same(both, intersect(b, a)) || !same(either, unite(b, a)) ||
      !same(difference, symmetric_difference(b, a)))
    return "operands may be swapped";
  const OverlapAreas areas = overlap_areas(a, b);
  if (areas.both_m2 != both.area() || areas.only_a_m2 != only_a.area() ||
      areas.only_b_m2 != only_b.area())
    return "areas of the overlay are those of its parts";
  // Each area is rounded once.
  if (std::abs(either.area() - (a.area() + b.area() - both.area())) > 4e-16 * (a.area() + b.area()))
    return "|A | B| is |A| + |B| - |A & B|";
  return {};
}

int check_laws(long count, std::uint64_t seed) {
  Random random(seed);
  long failures = 0;
  for (long i = 0; i < count; ++i) {
    const auto [a, b] = random_pair(random);
    std::string law;
    try {
      law = broken_law(a, b);
    } catch (const Error& error) {
      law = error.what();
    }
    if (law.empty()) continue;
    ++failures;
    std::printf("FAILED: pair %ld: %.1000s\n", i, law.c_str());
  }
  std::printf("%ld pairs: %ld failures\n", count, failures);
  return failures == 0 ? 0 : 1;
}

/// "x,y,x,y|x,y...;..." with ; between polygons and | between the rings of one.
std::vector<PolygonWithHoles> parsed(std::string_view text) {
  std::vector<PolygonWithHoles> polygons(1);
  Ring* ring = &polygons.back().outer;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at < end) {
    char* next = nullptr;
    const double x = std::strtod(at, &next);
    const double y = std::strtod(next + 1, &next);
    ring->emplace_back(x, y);
    at = next + 1;
    if (next < end && *next == '|') ring = &polygons.back().holes.emplace_back();
    if (next < end && *next == ';') ring = &polygons.emplace_back().outer;
  }
  return polygons;
}

std::string areas_of(const std::string& line_a, const std::string& line_b) {
  try {
    const Region a(parsed(line_a));
    const Region b(parsed(line_b));
    const OverlapAreas overlap = overlap_areas(a, b);
    std::string text = "=";
    for (const double area :
         {a.area(), b.area(), intersect(a, b).area(), unite(a, b).area(),
          symmetric_difference(a, b).area(), subtract(a, b).area(), subtract(b, a).area(),
          overlap.both_m2, overlap.only_a_m2, overlap.only_b_m2}) {
      text += " " + text_of(area);
    }
    return text;
  } catch (const Error& error) {
    return std::string("! ") + error.what();
  }
}

int print_areas(const char* path) {
  std::ifstream file(path);
  std::string a;
  std::string b;
  while (std::getline(file, a) && std::getline(file, b)) std::puts(areas_of(a, b).c_str());
  return 0;
}

}  // namespace
}  // namespace palpation

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: sweep_booleans COUNT SEED | --areas PAIRS\n", stderr);
    return 2;
  }
  if (std::string_view(argv[1]) == "--areas") return palpation::print_areas(argv[2]);
  return palpation::check_laws(std::atol(argv[1]), std::strtoull(argv[2], nullptr, 10));
}
