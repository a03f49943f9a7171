#include "exploration/felt_since.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "readings/readings.h"

namespace palpation {
namespace {

/// Of readings in the tumour, and of others.
constexpr int kFewestAtEdge = 3;
/// Of those before or since, whichever are fewer, more than one in so many has one of the others
/// beside it: within a field's length, or among the readings nearest to it.
constexpr std::ptrdiff_t kOneInAgain = 2, kNearest = 4;
constexpr double kSameGround_m = 0.0035;

bool is_beside(const Vec3& here, const std::vector<Vec3>& own, const std::vector<Vec3>& others) {
  double nearest2 = std::numeric_limits<double>::infinity();
  for (const Vec3& there : others) nearest2 = std::min(nearest2, (there - here).squaredNorm());
  if (nearest2 <= kSameGround_m * kSameGround_m) return true;
  // Itself apart.
  const auto nearer = std::ranges::count_if(
      own, [&](const Vec3& there) { return (there - here).squaredNorm() < nearest2; });
  return nearer - 1 < kNearest;
}

}  // namespace

bool is_felt_on_both_sides(const Misfit& change, double level,
                           std::span<const Palpation> readings) {
  std::array<std::array<int, 2>, 2> felt{};  // since or before, above the level or below
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const Palpation& one = readings[i];
    if (counts(one)) ++felt[is_since(change, made_of(readings, i))][one.reading >= level];
  }
  return std::ranges::all_of(
      felt, [](const auto& side) { return std::ranges::min(side) >= kFewestAtEdge; });
}

bool is_felt_again(const Misfit& change, const Surface& surface,
                   std::span<const Palpation> readings) {
  std::vector<Vec3> before, since;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const Palpation& one = readings[i];
    if (counts(one))
      (is_since(change, made_of(readings, i)) ? since : before)
          .push_back(surface.position(one.where));
  }
  const auto& [fewer, more] = std::minmax(
      before, since, [](const auto& one, const auto& other) { return one.size() < other.size(); });
  const auto again = std::ranges::count_if(fewer, [&own = fewer, &others = more](const Vec3& here) {
    return is_beside(here, own, others);
  });
  return kOneInAgain * again > std::ssize(fewer);
}

}  // namespace palpation
