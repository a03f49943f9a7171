// Rings of any doubles: regions of them, and the laws of Booleans. No error of the arithmetic is
// accepted here.
#include <algorithm>
#include <cmath>
#include <vector>

#include "fuzz/target.h"
#include "palpation/base/error.h"
#include "palpation/boundary/region.h"

namespace palpation::fuzz {
namespace {

constexpr int kMostRings = 3;
constexpr int kMostCorners = 12;

std::vector<Ring> rings_of(Numbers& numbers) {
  std::vector<Ring> rings(1 + numbers.byte() % kMostRings);
  for (Ring& ring : rings) {
    const int corners = numbers.byte() % kMostCorners;
    for (int i = 0; i < corners && numbers.any_left(); ++i) {
      const double x = numbers.real();
      ring.emplace_back(x, numbers.real());
    }
  }
  return rings;
}

void check_laws(const Region& a, const Region& b) {
  const Region both = intersect(a, b), either = unite(a, b),
               difference = symmetric_difference(a, b);
  expect(symmetric_difference(difference, unite(subtract(a, b), subtract(b, a))).empty(),
         "A ^ B is A - B and B - A");
  expect(symmetric_difference(subtract(either, both), difference).empty(),
         "A ^ B is A + B without A & B");
  expect(subtract(both, a).empty() && subtract(a, either).empty(), "A & B is in A, and A in A + B");
  expect(symmetric_difference(a, a).empty(), "A ^ A is empty");
  for (const PolygonWithHoles& polygon : a.polygons())
    expect(polygon.outer.size() >= 3, "a ring has three corners");
}

}  // namespace
}  // namespace palpation::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace palpation;
  fuzz::Numbers numbers(bytes, size);
  try {
    const std::vector<Ring> first = fuzz::rings_of(numbers), second = fuzz::rings_of(numbers);
    fuzz::check_laws(Region::even_odd(first), Region::even_odd(second));
    const std::vector<PolygonWithHoles> strict{{first.front(), {first.begin() + 1, first.end()}}};
    const Region region(strict);
    fuzz::expect(symmetric_difference(region, Region::even_odd(first)).empty(),
                 "what is valid is what the even-odd rule makes of it");
  } catch (const InvalidInput&) {
  }
  return 0;
}
