// Readings since some moment, or before it, that no sensor gives in the unit of the others.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "readings/robust.h"
#include "readings/screen.h"

namespace palpation {
namespace {

constexpr std::ptrdiff_t kFewest = 8;       // readings on either side
constexpr std::ptrdiff_t kOneInOther = 20;  // of a side may have the other's sign
constexpr double kOfTwoHeights = 0.85;  // of a variance; of one height two parts explain 0.64, 0.75
constexpr double kAlike = 0.5;          // of the way between two heights
constexpr double kLarger = 100.0;       // times; units differ by a thousand, bone and fat by less
constexpr std::ptrdiff_t kOneInBefore = 4;  // of a session, and what came first is in error

struct TwoHeights {
  double low = 0.0, high = 0.0;
  bool are_told = false;  ///< noise does not make values lie so far apart
};

/// That explain the most of how values vary.
TwoHeights two_heights(std::vector<double> values) {
  std::ranges::sort(values);
  const auto count = static_cast<double>(values.size());
  double all = 0.0, squares = 0.0;
  for (const double value : values) all += value;
  for (const double value : values) squares += std::pow(value - all / count, 2);
  TwoHeights best;
  double most = 0.0, below = 0.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    below += values[i - 1];
    const auto part = static_cast<double>(i);
    const TwoHeights heights{below / part, (all - below) / (count - part)};
    const double explained =
        part * (count - part) / count * std::pow(heights.high - heights.low, 2);
    if (explained > most) most = explained, best = heights;
  }
  best.are_told = most > kOfTwoHeights * squares;
  return best;
}

std::vector<double> sizes_of(std::span<const double> readings) {
  std::vector<double> sizes;
  for (const double reading : readings) sizes.push_back(std::abs(reading));
  return sizes;
}

/// The moment since which nearly all have another sign than nearly all before, if one of the two
/// tells two heights and the other is about of these: else zero may lie between tissue and tumour,
/// or the sensor's have moved.
std::optional<std::ptrdiff_t> turned_at(std::span<const double> readings) {
  const auto count = std::ssize(readings);
  const auto positive = std::ranges::count_if(readings, [](double one) { return one > 0.0; });
  std::ptrdiff_t before = 0, least = count, moment = 0;
  for (std::ptrdiff_t i = 1; i + kFewest <= count; ++i) {
    before += readings[static_cast<std::size_t>(i) - 1] > 0.0;
    const auto since = positive - before;
    const auto others = std::min(before + (count - i - since), (i - before) + since);
    if (i >= kFewest && others < least) least = others, moment = i;
  }
  if (moment == 0 || kOneInOther * least > std::min(moment, count - moment)) return std::nullopt;
  const auto first = static_cast<std::size_t>(moment);
  const TwoHeights one = two_heights(sizes_of(readings.first(first))),
                   other = two_heights(sizes_of(readings.subspan(first)));
  const auto is_among = [](const TwoHeights& some, const TwoHeights& told) {
    const double near = kAlike * (told.high - told.low);
    return told.are_told && some.low > told.low - near && some.high < told.high + near;
  };
  if (!is_among(one, other) && !is_among(other, one)) return std::nullopt;
  return moment;
}

/// The moment since which all are that much larger than all before, or smaller, by more than either
/// side spreads: about zero readings are any number of times as large.
std::optional<std::ptrdiff_t> scaled_at(std::span<const double> readings) {
  const std::vector<double> sizes = sizes_of(readings);
  const auto count = std::ssize(sizes);
  std::vector<double> least(sizes), most(sizes);  // of those since each
  for (std::size_t i = sizes.size() - 1; i-- > 0;) {
    least[i] = std::min(least[i], least[i + 1]);
    most[i] = std::max(most[i], most[i + 1]);
  }
  double least_before = std::numeric_limits<double>::infinity(), most_before = 0.0;
  for (std::ptrdiff_t i = 1; i + kFewest <= count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    least_before = std::min(least_before, sizes[at - 1]);
    most_before = std::max(most_before, sizes[at - 1]);
    const bool rises = least[at] > most_before;
    const double upper_least = rises ? least[at] : least_before,
                 upper_most = rises ? most[at] : most_before,
                 lower_least = rises ? least_before : least[at],
                 lower_most = rises ? most_before : most[at];
    if (i >= kFewest && upper_least > kLarger * lower_most &&
        upper_least * lower_least > lower_most * lower_most &&
        upper_least * upper_least > lower_most * upper_most)
      return i;
  }
  return std::nullopt;
}

}  // namespace

void find_another_unit(Screen& screen) {
  std::map<int, std::vector<std::size_t>> sessions;
  for (std::size_t i = 0; i < screen.palpations.size(); ++i) {
    if (counts(screen.palpations[i])) sessions[screen.palpations[i].session].push_back(i);
  }
  for (auto& [session, numbers] : sessions) {
    // Contact that was lost now and then has neither sign nor size.
    const auto is_nothing = [&](std::size_t i) { return screen.reading(i) == 0.0; };
    if (kOneInOther * std::ranges::count_if(numbers, is_nothing) <= std::ssize(numbers))
      std::erase_if(numbers, is_nothing);
    const auto count = std::ssize(numbers);
    if (count < 2 * kFewest) continue;
    std::vector<double> readings;
    for (const std::size_t i : numbers) readings.push_back(screen.reading(i));
    const std::optional<std::ptrdiff_t> turned = turned_at(readings),
                                        moment = turned ? turned : scaled_at(readings);
    if (!moment) continue;
    const auto middle = static_cast<std::size_t>(*moment);
    // What is stiffer reads more.
    const bool is_before = turned ? median({readings.begin(), readings.begin() + *moment}) < 0.0
                                  : kOneInBefore * *moment < count;
    const std::span<const std::size_t> all = numbers;
    for (const std::size_t i : is_before ? all.first(middle) : all.subspan(middle))
      screen.set_aside(i, kAnotherUnit);
  }
}

}  // namespace palpation
