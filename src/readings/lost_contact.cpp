#include "readings/lost_contact.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

namespace palpation {
namespace {

constexpr std::size_t kFewReadings = 10;
constexpr std::size_t kPart = 4;                     // one in so many
constexpr std::size_t kWildPart = 20;                // one in so many may be far above all others
constexpr std::size_t kAround = 4, kContradict = 2;  // nearest readings, and of them

/// The readings nearest to one, but for itself, by their ranks.
class Around {
 public:
  Around(std::size_t rank, std::span<const std::size_t> rising, std::span<const Vec3> places) {
    for (std::size_t other = 0; other < rising.size(); ++other) {
      if (other == rank) continue;
      const Near one{(places[rising[other]] - places[rising[rank]]).squaredNorm(), other};
      if (!(one.distance2 < nearest_.back().distance2)) continue;
      nearest_.back() = one;
      std::ranges::sort(nearest_, {}, &Near::distance2);
    }
  }

  /// Squared, to the nearest that contradict a low one: infinite where they are too few, most of
  /// all being among the lowest.
  double contradicted_within2(std::size_t low) const {
    std::size_t others = 0;
    for (const Near& one : nearest_) {
      if (one.rank >= low && ++others == kContradict) return one.distance2;
    }
    return std::numeric_limits<double>::infinity();
  }

 private:
  struct Near {
    double distance2 = std::numeric_limits<double>::infinity();
    std::size_t rank = 0;
  };
  std::array<Near, kAround> nearest_;
};

/// How far from each of the others those lie that would contradict it, all but a twentieth of them.
double usually_within2(std::size_t low, std::span<const std::size_t> rising,
                       std::span<const Vec3> places) {
  std::vector<double> within2;
  for (std::size_t rank = low; rank < rising.size(); ++rank) {
    const std::size_t own = rank - low;
    within2.push_back(Around(own, rising.subspan(low), places).contradicted_within2(/*low=*/0));
  }
  const auto most =
      within2.end() - 1 - std::ssize(within2) / static_cast<std::ptrdiff_t>(kWildPart);
  std::nth_element(within2.begin(), most, within2.end());
  return *most;
}

/// Whether at least half of the lowest are.
bool are_contradicted(std::size_t low, std::span<const std::size_t> rising,
                      std::span<const Vec3> places) {
  const double near2 = usually_within2(low, rising, places);
  std::size_t contradicted = 0;
  for (std::size_t rank = 0; rank < low; ++rank)
    contradicted += Around(rank, rising, places).contradicted_within2(low) <= near2;
  return 2 * contradicted >= low;
}

/// Of the readings with these numbers.
std::vector<std::size_t> lost_among(std::span<const Palpation> palpations,
                                    std::span<const Vec3> places, std::vector<std::size_t> rising) {
  if (rising.size() < kFewReadings) return {};
  const auto reading = [&](std::size_t rank) { return palpations[rising[rank]].reading; };
  std::ranges::stable_sort(rising, {}, [&](std::size_t i) { return palpations[i].reading; });

  const double greatest = reading(rising.size() - 1 - rising.size() / kWildPart);
  for (std::size_t low = rising.size() / kPart; low > 0; --low) {
    const bool is_far_below = reading(low) - reading(low - 1) > greatest - reading(low);
    if (!is_far_below || !are_contradicted(low, rising, places)) continue;
    return {rising.begin(), rising.begin() + static_cast<std::ptrdiff_t>(low)};
  }
  return {};
}

}  // namespace

std::vector<std::size_t> lost_contact(std::span<const Palpation> palpations,
                                      std::span<const Vec3> places) {
  std::map<int, std::vector<std::size_t>> sessions;
  for (std::size_t i = 0; i < palpations.size(); ++i) {
    if (counts(palpations[i])) sessions[palpations[i].session].push_back(i);
  }
  std::vector<std::size_t> found;
  for (auto& [session, numbers] : sessions) {
    const std::vector<std::size_t> lost = lost_among(palpations, places, std::move(numbers));
    found.insert(found.end(), lost.begin(), lost.end());
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace palpation
