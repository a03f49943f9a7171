// Readings since some moment, or before it, that no sensor gives in the unit of the others.
#include <algorithm>
#include <cmath>
#include <map>

#include "readings/robust.h"
#include "readings/screen.h"

namespace palpation {
namespace {

constexpr std::size_t kFewest = 8;       // readings on either side
constexpr std::size_t kOneInOther = 20;  // of a side may have the other's sign
constexpr double kAsLarge = 2.0;         // times, with another sign
constexpr double kLarger = 100.0;        // times; units differ by a thousand, bone and fat by less

using Numbers = std::vector<std::size_t>;  // rising, of a session's readings that are not 0

double median_size(const Screen& screen, Numbers::const_iterator first,
                   Numbers::const_iterator last) {
  std::vector<double> sizes;
  std::transform(first, last, std::back_inserter(sizes),
                 [&](std::size_t i) { return std::abs(screen.reading(i)); });
  return median(sizes);
}

bool is_turned(const Screen& screen, const Numbers& all, Numbers::const_iterator moment) {
  const auto positive = [&](std::size_t i) { return screen.reading(i) > 0.0; };
  const auto count = [&](Numbers::const_iterator first, Numbers::const_iterator last) {
    return std::pair(static_cast<std::size_t>(std::count_if(first, last, positive)),
                     static_cast<std::size_t>(last - first));
  };
  const auto [before, of_before] = count(all.begin(), moment);
  const auto [since, of_since] = count(moment, all.end());
  const auto nearly_all = [](std::size_t some, std::size_t of) {
    return kOneInOther * (of - some) <= of;
  };
  if (!(nearly_all(before, of_before) && nearly_all(of_since - since, of_since)) &&
      !(nearly_all(of_before - before, of_before) && nearly_all(since, of_since)))
    return false;
  const double times =
      median_size(screen, moment, all.end()) / median_size(screen, all.begin(), moment);
  return times <= kAsLarge && times >= 1.0 / kAsLarge;
}

/// By more than either side spreads: about zero readings are any number of times as large.
bool is_larger(const Screen& screen, const Numbers& all, Numbers::const_iterator moment) {
  const auto size = [&](std::size_t i) { return std::abs(screen.reading(i)); };
  const auto range_of = [&](Numbers::const_iterator first, Numbers::const_iterator last) {
    const auto [least, most] = std::ranges::minmax(std::ranges::subrange(first, last), {}, size);
    return std::pair(size(least), size(most));
  };
  const auto before = range_of(all.begin(), moment), since = range_of(moment, all.end());
  const auto& [lower, upper] = std::minmax(before, since);
  return upper.first > kLarger * lower.second &&
         upper.first * lower.first > lower.second * lower.second &&
         upper.first * upper.first > lower.second * upper.second;
}

}  // namespace

void find_another_unit(Screen& screen) {
  std::map<int, Numbers> sessions;
  for (std::size_t i = 0; i < screen.palpations.size(); ++i) {
    if (counts(screen.palpations[i]) && screen.reading(i) != 0.0)
      sessions[screen.palpations[i].session].push_back(i);
  }
  for (const auto& [session, all] : sessions) {
    if (all.size() < 2 * kFewest) continue;
    for (auto moment = all.begin() + kFewest; moment + kFewest <= all.end(); ++moment) {
      const double here = screen.reading(*moment), last = screen.reading(*(moment - 1));
      const bool turns = (here > 0.0) != (last > 0.0);
      const bool jumps =
          std::abs(here) > kLarger * std::abs(last) || std::abs(last) > kLarger * std::abs(here);
      if (!(turns && is_turned(screen, all, moment)) && !(jumps && is_larger(screen, all, moment)))
        continue;
      const bool are_fewer_before = moment - all.begin() < all.end() - moment;
      const auto fewer = are_fewer_before ? std::ranges::subrange(all.begin(), moment)
                                          : std::ranges::subrange(moment, all.end());
      for (const std::size_t i : fewer) screen.set_aside(i, kAnotherUnit);
      break;
    }
  }
}

}  // namespace palpation
