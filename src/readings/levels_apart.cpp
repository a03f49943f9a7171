#include <algorithm>
#include <cmath>

#include "readings/readings.h"
#include "readings/screen.h"

namespace palpation {
namespace {

constexpr double kGapShare =
    0.03;  // of the smaller group, in a gap: an edge of tissue leaves four times as many
constexpr double kLeastGroup = 0.01;  // of the readings: fewer are outliers, judged one by one
constexpr double kSoundShare = 0.15;  // of the readings: tissue's own group is no smaller
constexpr double kMostPokesApart =
    0.05;  // of the readings: a poke fails alone, and few pokes fall on a tumour's edge

/// A stretch of values that next to no reading has, between two groups of readings.
struct Gap {
  double low = 0.0;
  double high = 0.0;
  std::size_t below = 0;  // readings
  std::size_t above = 0;
  double width() const { return high - low; }
};

/// The widest gap that no tissue leaves; of width 0 where there is none. `sorted` rises.
Gap widest_gap(const std::vector<double>& sorted) {
  Gap best;
  const auto least =
      static_cast<std::size_t>(std::ceil(kLeastGroup * static_cast<double>(sorted.size())));
  for (std::size_t below = std::max<std::size_t>(least, 1), upper = below;
       below + least <= sorted.size(); ++below) {
    // The farthest reading that leaves few enough in between.
    upper = std::max(upper, below);
    const auto few_between = [&](std::size_t first_above) {
      const std::size_t smaller = std::min(below, sorted.size() - first_above);
      return static_cast<double>(first_above - below) <= kGapShare * static_cast<double>(smaller);
    };
    while (upper + least < sorted.size() && few_between(upper + 1)) ++upper;
    if (!few_between(upper)) continue;
    const Gap gap{sorted[below - 1], sorted[upper], below, sorted.size() - upper};
    const double middle_below = sorted[below / 2],
                 middle_above = sorted[upper + (sorted.size() - upper) / 2];
    if (gap.width() > best.width() && gap.width() > kGapWidth * (middle_above - middle_below))
      best = gap;
  }
  return best;
}

/// The widest stretch within the gap that no reading has at all: the few others in it belong to the
/// side where they are.
Gap empty_part(const std::vector<double>& sorted, const Gap& gap) {
  Gap widest{gap.low, gap.low, gap.below, gap.above};
  for (std::size_t i = gap.below; i < sorted.size() && sorted[i - 1] < gap.high; ++i) {
    if (sorted[i] - sorted[i - 1] > widest.width())
      widest = {sorted[i - 1], sorted[i], i, sorted.size() - i};
  }
  return widest;
}

}  // namespace

void find_levels_apart(Screen& screen, bool pokes) {
  for (int round = 0; round < 4; ++round) {
    std::vector<double> sorted = used_readings(screen.palpations);
    if (sorted.empty()) return;
    std::sort(sorted.begin(), sorted.end());
    Gap gap = widest_gap(sorted);
    // A gap narrower than tissue's own readings are spread is one of its own steps.
    if (gap.width() <= 0.0) return;
    const bool lower_is_tissue =
        static_cast<double>(gap.below) >= kSoundShare * static_cast<double>(sorted.size());
    const double spread =
        lower_is_tissue ? sorted[gap.below - 1] - sorted[gap.below / 50] : sorted.back() - gap.high;
    if (gap.width() <= 0.5 * spread) return;
    gap = empty_part(sorted, gap);
    if (pokes && static_cast<double>(std::min(gap.below, gap.above)) >
                     kMostPokesApart * static_cast<double>(sorted.size()))
      return;
    for (std::size_t i = 0; i < screen.palpations.size(); ++i) {
      if (lower_is_tissue && screen.reading(i) > gap.low) screen.set_aside(i, kJammed);
      if (!lower_is_tissue && screen.reading(i) < gap.high) screen.set_aside(i, kNoContact);
    }
  }
}

}  // namespace palpation
