#include "exploration/felt_since.h"

#include <algorithm>
#include <array>
#include <vector>

namespace palpation {
namespace {

/// Of readings in the tumour, and of others.
constexpr int kFewestAtEdge = 3;
/// Of those before or since, whichever are fewer, more than one in so many lies as near to one of
/// the others: a field's length.
constexpr std::ptrdiff_t kOneInAgain = 2;
constexpr double kSameGround_m = 0.0035;

bool is_made_since(const Misfit& change, std::span<const Palpation> readings, std::size_t i) {
  return is_since(change, {readings[i].batch, i, readings[i].session});
}

}  // namespace

bool is_felt_on_both_sides(const Misfit& change, double level,
                           std::span<const Palpation> readings) {
  std::array<std::array<int, 2>, 2> felt{};  // since or before, above the level or below
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const Palpation& one = readings[i];
    if (counts(one)) ++felt[is_made_since(change, readings, i)][one.reading >= level];
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
      (is_made_since(change, readings, i) ? since : before).push_back(surface.position(one.where));
  }
  const auto& [fewer, more] = std::minmax(
      before, since, [](const auto& one, const auto& other) { return one.size() < other.size(); });
  const auto again = std::ranges::count_if(fewer, [&more = more](const Vec3& here) {
    return std::ranges::any_of(more, [&](const Vec3& there) {
      return (here - there).squaredNorm() <= kSameGround_m * kSameGround_m;
    });
  });
  return kOneInAgain * again > std::ssize(fewer);
}

}  // namespace palpation
