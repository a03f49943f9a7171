#include "readings/lost_contact.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

namespace palpation {
namespace {

constexpr std::size_t kFewReadings = 10;
constexpr std::size_t kPart = 4;       // one in so many
constexpr std::size_t kWildPart = 20;  // one in so many may be far above all others
constexpr std::size_t kAround = 4;

/// How many of the readings nearest to a place are among the lowest.
std::size_t low_around(std::size_t here, std::span<const std::size_t> rising, std::size_t low,
                       std::span<const Vec3> places) {
  struct Near {
    double distance2 = std::numeric_limits<double>::infinity();
    bool is_low = false;
    bool operator<(const Near& other) const { return distance2 < other.distance2; }
  };
  std::array<Near, kAround> nearest;
  for (std::size_t rank = 0; rank < rising.size(); ++rank) {
    if (rising[rank] == here) continue;
    const Near one{(places[rising[rank]] - places[here]).squaredNorm(), rank < low};
    if (!(one < nearest.back())) continue;
    nearest.back() = one;
    std::sort(nearest.begin(), nearest.end());
  }
  return static_cast<std::size_t>(std::ranges::count(nearest, true, &Near::is_low));
}

/// Of the readings with these numbers.
std::vector<std::size_t> lost_among(std::span<const Palpation> palpations,
                                    std::span<const Vec3> places, std::vector<std::size_t> rising) {
  if (rising.size() < kFewReadings) return {};
  const auto reading = [&](std::size_t rank) { return palpations[rising[rank]].reading; };
  std::ranges::stable_sort(rising, {}, [&](std::size_t i) { return palpations[i].reading; });

  const double greatest = reading(rising.size() - 1 - rising.size() / kWildPart);
  std::size_t low = 0;
  for (std::size_t count = 1; count <= rising.size() / kPart; ++count) {
    if (reading(count) - reading(count - 1) > greatest - reading(count)) low = count;
  }
  const std::span lowest = std::span(rising).first(low);
  const auto contradicted = std::ranges::count_if(
      lowest, [&](std::size_t i) { return low_around(i, rising, low, places) <= kAround / 2; });
  if (2 * static_cast<std::size_t>(contradicted) < low) return {};
  return {lowest.begin(), lowest.end()};
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
