#include "palpation/readings/screening.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "readings/outliers.h"
#include "readings/passes.h"
#include "readings/readings.h"
#include "readings/robust.h"

namespace palpation {
namespace {

// The probe of Garg et al. 2016, section VII: a tip 4.5 mm wide.
constexpr double kTipWidth_m = 0.0045;
constexpr std::size_t kLeastFrozen =
    8;  // readings: chance repeats the last digit of a plateau a few times

constexpr double kAcross = 0.6;        // of the longest pass: a row that crosses most of the tissue
constexpr std::size_t kLeastRows = 3;  // fewer say nothing about what rows have in common
constexpr double kMostOfAll = 0.5;     // of all readings lie on rows, or it is no scan

constexpr double kFlat = 0.05;      // of the rows' usual range: no contact, no change
constexpr double kGapWidth = 0.25;  // of the way between two groups of readings, without ...
constexpr double kGapShare =
    0.03;  // ... this share of the smaller group: an edge of tissue leaves four times as many
constexpr double kLeastGroup = 0.01;  // of the readings: fewer are outliers, judged one by one
constexpr double kSoundShare = 0.15;  // of the readings: tissue's own group is no smaller
constexpr double kMostPokesApart =
    0.05;  // of the readings: a poke fails alone, and few pokes fall on a tumour's edge
constexpr double kStartUp_m = 0.003;  // after rest until the probe reads true
constexpr double kSliding_m =
    0.0011;  // between readings made in motion; farther apart they are pokes, each from rest
constexpr double kDense_m =
    0.0005;  // between readings: several to a millimetre, where tissue turns slowly ...
constexpr double kTurnShare = 0.05;  // ... by less than this part of a step at one reading
constexpr std::size_t kLeastToBeGross = 20;
constexpr double kGrossBelow = 10.0;  // ranges of nine tenths of the readings
constexpr double kGrossAbove =
    1000.0;                    // the same: a tumour stands out of noise of 0.1 % by three hundred
constexpr double kSure = 4.0;  // robust standard deviations
constexpr double kBaseShare =
    0.5;  // of the contrast: a row's base that steps as far as half a tumour

struct Screen {
  const Surface& surface;
  std::vector<Palpation>& palpations;
  std::vector<Vec3> places;

  bool uses(std::size_t i) const { return palpations[i].set_aside.empty(); }
  double reading(std::size_t i) const { return palpations[i].reading; }
  void set_aside(std::size_t i, const std::string& reason) {
    if (uses(i)) palpations[i].set_aside = reason;
  }
  std::vector<double> used(const std::vector<std::size_t>& of) const {
    std::vector<double> values;
    for (std::size_t i : of) {
      if (uses(i)) values.push_back(reading(i));
    }
    return values;
  }
  std::vector<double> used() const {
    std::vector<double> values;
    for (std::size_t i = 0; i < palpations.size(); ++i) {
      if (uses(i)) values.push_back(reading(i));
    }
    return values;
  }
};

/// Runs of one number while the probe moves. A sensor with few steps repeats itself by nature.
void find_frozen(Screen& screen) {
  std::vector<double> distinct = screen.used();
  const std::size_t count = distinct.size();
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  const bool is_coarse = distinct.size() > 1 && distinct.size() < count / 4;
  if (is_coarse) return;
  for (std::size_t first = 0, last = 0; first < screen.places.size(); first = last + 1) {
    double path_m = 0.0;
    for (last = first;
         last + 1 < screen.places.size() && screen.reading(last + 1) == screen.reading(first);
         ++last) {
      path_m += (screen.places[last + 1] - screen.places[last]).norm();
    }
    if (last - first + 1 < kLeastFrozen || path_m <= kTipWidth_m) continue;
    for (std::size_t i = first; i <= last; ++i) screen.set_aside(i, kFrozen);
  }
}

/// Low readings of a row: healthy tissue's.
double base_of(const std::vector<double>& row) { return quantile(row, 0.1); }
double range_of(const std::vector<double>& row) {
  return quantile(row, 0.95) - quantile(row, 0.05);
}

/// Rows with next to no change that lie apart from the nearest rows that have some: those between
/// them may have drifted, a step a row.
void find_flat_rows(Screen& screen, const std::vector<Pass>& rows) {
  std::vector<double> bases, ranges;
  for (const Pass& row : rows) {
    const std::vector<double> values = screen.used(row);
    bases.push_back(values.empty() ? 0.0 : base_of(values));
    ranges.push_back(values.empty() ? 0.0 : range_of(values));
  }
  const double usual = median(ranges);
  std::vector<std::size_t> alive;
  std::vector<double> steps;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (ranges[i] < kFlat * usual || ranges[i] == 0.0) continue;
    if (!alive.empty())
      steps.push_back(std::abs(bases[i] - bases[alive.back()]) /
                      static_cast<double>(i - alive.back()));
    alive.push_back(i);
  }
  if (alive.size() < kLeastRows) return;
  const double usual_step = std::max(median(steps), kFlat * usual);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (ranges[i] >= kFlat * usual) continue;
    const auto is_near = [&](std::size_t other) {
      const double rows_between = std::abs(static_cast<double>(i) - static_cast<double>(other));
      return std::abs(bases[i] - bases[other]) <= kSure * usual_step * rows_between;
    };
    const auto after = std::upper_bound(alive.begin(), alive.end(), i);
    if ((after != alive.end() && is_near(*after)) ||
        (after != alive.begin() && is_near(*(after - 1))))
      continue;
    for (std::size_t reading : rows[i]) screen.set_aside(reading, kNoContact);
  }
}

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

/// Jams lie above tissue's readings, lost contact below them.
void find_levels_apart(Screen& screen, bool pokes) {
  for (int round = 0; round < 4; ++round) {
    std::vector<double> sorted = screen.used();
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

/// Median of the readings on a row between two distances from its start; nothing without any.
std::optional<double> reading_between(const Screen& screen, const Pass& row, double least_m,
                                      double most_m) {
  std::vector<double> values;
  for (std::size_t i : row) {
    const double far_m = (screen.places[i] - screen.places[row.front()]).norm();
    if (screen.uses(i) && far_m >= least_m && far_m <= most_m) values.push_back(screen.reading(i));
  }
  if (values.empty()) return std::nullopt;
  return median(values);
}

/// How much a row changes from one millimetre to the two that start three millimetres on.
std::optional<double> change_at(const Screen& screen, const Pass& row, double from_m) {
  const auto here = reading_between(screen, row, from_m, from_m + 0.001);
  const auto there = reading_between(screen, row, from_m + kStartUp_m, from_m + kStartUp_m + 0.002);
  if (!here || !there) return std::nullopt;
  return *there - *here;
}

void find_start_ups(Screen& screen, const std::vector<Pass>& rows) {
  std::vector<double> at_start, elsewhere;
  for (const Pass& row : rows) {
    if (median_step_m(screen.places, row) > kSliding_m) continue;
    if (const auto change = change_at(screen, row, 0.0)) at_start.push_back(*change);
    const double length_m = (screen.places[row.back()] - screen.places[row.front()]).norm();
    for (double from_m = 2.0 * kStartUp_m; from_m + 2.0 * kStartUp_m < length_m;
         from_m += kStartUp_m) {
      if (const auto change = change_at(screen, row, from_m)) elsewhere.push_back(*change);
    }
  }
  if (at_start.size() < kLeastRows || elsewhere.empty()) return;
  const double common = median(at_start);
  const auto alike = std::count_if(at_start.begin(), at_start.end(),
                                   [&](double change) { return change * common > 0.0; });
  if (static_cast<double>(alike) < 0.75 * static_cast<double>(at_start.size())) return;
  for (double& change : elsewhere) change = std::abs(change);
  if (std::abs(common) <= 2.0 * median(elsewhere)) return;
  for (const Pass& row : rows) {
    for (std::size_t i : row) {
      if ((screen.places[i] - screen.places[row.front()]).norm() <= kStartUp_m)
        screen.set_aside(i, kStartUp);
    }
  }
}

/// The range of the readings on all rows but one; nothing without any.
std::optional<std::pair<double, double>> range_of_others(const Screen& screen,
                                                         const std::vector<Pass>& rows,
                                                         const Pass& row) {
  std::vector<double> others;
  for (const Pass& other : rows) {
    if (&other == &row) continue;
    const std::vector<double> values = screen.used(other);
    others.insert(others.end(), values.begin(), values.end());
  }
  if (others.empty()) return std::nullopt;
  const auto [least, greatest] = std::minmax_element(others.begin(), others.end());
  return std::pair(*least, *greatest);
}

/// What comes next to a fault on its row belongs to it as far as it lies outside the range of the
/// other rows: the probe's filter takes its time.
void find_transitions(Screen& screen, const std::vector<Pass>& rows) {
  for (const Pass& row : rows) {
    for (const std::string& reason : {kJammed, kNoContact}) {
      const auto is_fault = [&](std::size_t i) { return screen.palpations[i].set_aside == reason; };
      if (std::none_of(row.begin(), row.end(), is_fault)) continue;
      const auto range = range_of_others(screen, rows, row);
      if (!range) return;
      const auto is_outside = [&](std::size_t i) {
        return reason == kJammed ? screen.reading(i) > range->second
                                 : screen.reading(i) < range->first;
      };
      for (std::size_t i = 1; i < row.size(); ++i) {
        if (is_fault(row[i - 1]) && is_outside(row[i])) screen.set_aside(row[i], reason);
      }
      for (std::size_t i = row.size() - 1; i > 0; --i) {
        if (is_fault(row[i]) && is_outside(row[i - 1])) screen.set_aside(row[i - 1], reason);
      }
    }
  }
}

/// The greatest turn of a row's course at one reading: where its slope changes at once. A filtered
/// step has one at its onset; tissue, felt by a tip of several millimetres, turns over many
/// readings.
struct Turn {
  std::size_t at = 0;  // the last reading before it, in the row
  double size = 0.0;
};

Turn sharpest_turn(const Screen& screen, const Pass& row) {
  Turn sharpest;
  for (std::size_t i = 1; i + 1 < row.size(); ++i) {
    if (!screen.uses(row[i - 1]) || !screen.uses(row[i]) || !screen.uses(row[i + 1])) continue;
    const double turn = std::abs(screen.reading(row[i + 1]) - 2.0 * screen.reading(row[i]) +
                                 screen.reading(row[i - 1]));
    if (turn > sharpest.size) sharpest = {i, turn};
  }
  return sharpest;
}

/// Rows of which one end lies apart from the readings of all other rows, up to a sharp turn: the
/// probe jammed or hung in the air there.
void find_parts_apart(Screen& screen, const std::vector<Pass>& rows) {
  std::vector<double> turns;
  for (const Pass& row : rows) {
    if (median_step_m(screen.places, row) <= kDense_m)
      turns.push_back(sharpest_turn(screen, row).size);
  }
  if (turns.size() < kLeastRows) return;
  const double usual_turn = median(turns);
  for (const Pass& row : rows) {
    const Turn turn = sharpest_turn(screen, row);
    if (median_step_m(screen.places, row) > kDense_m || turn.size <= kSure * usual_turn) continue;
    const auto range = range_of_others(screen, rows, row);
    if (!range) continue;
    const auto [least, greatest] = *range;
    const double margin = kGapWidth * (greatest - least);
    const auto is_apart = [&](std::size_t first, std::size_t last, double sign, double bound) {
      for (std::size_t i = first; i < last; ++i) {
        if (screen.uses(row[i]) && sign * (screen.reading(row[i]) - bound) <= margin) return false;
      }
      return true;
    };
    for (const double sign : {1.0, -1.0}) {
      const double bound = sign > 0.0 ? greatest : least;
      const bool before = is_apart(0, turn.at + 1, sign, bound),
                 after = is_apart(turn.at + 1, row.size(), sign, bound);
      if (before == after) continue;  // a whole row apart is not this fault
      const double step = std::abs(screen.reading(row[turn.at]) - bound);
      if (turn.size <= kTurnShare * step) continue;
      for (std::size_t i = before ? 0 : turn.at + 1; i < (before ? turn.at + 1 : row.size()); ++i) {
        screen.set_aside(row[i], sign > 0.0 ? kJammed : kNoContact);
      }
    }
  }
}

void find_base_steps(Screen& screen, const std::vector<Pass>& rows) {
  std::vector<const Pass*> sound;
  std::vector<double> bases;
  double contrast = 0.0;  // the most that one row shows
  for (const Pass& row : rows) {
    const std::vector<double> values = screen.used(row);
    if (2 * values.size() < row.size()) continue;
    sound.push_back(&row);
    bases.push_back(base_of(values));
    contrast = std::max(contrast, range_of(values));
  }
  if (bases.size() < kLeastRows + 1) return;
  std::vector<double> steps;
  for (std::size_t i = 0; i < bases.size(); ++i) {
    std::vector<double> around;
    for (std::size_t j = i < 2 ? 0 : i - 2; j <= i + 2 && j < bases.size(); ++j) {
      if (j != i) around.push_back(bases[j]);
    }
    const double step = bases[i] - median(around);
    // A tilt goes on beyond the last row but one.
    const std::size_t next = i == 0 ? 1 : i - 1, after = i == 0                  ? 2
                                                         : i + 1 == bases.size() ? i - 2
                                                                                 : i + 1;
    const double bend =
        i == 0 || i + 1 == bases.size() ? bases[i] - 2.0 * bases[next] + bases[after] : step;
    steps.push_back(
        step * bend > 0.0 ? std::copysign(std::min(std::abs(step), std::abs(bend)), step) : 0.0);
  }
  const double scale = robust_sd(steps);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (std::abs(steps[i]) <= std::max(kBaseShare * contrast, kSure * scale)) continue;
    for (std::size_t reading : *sound[i]) screen.set_aside(reading, kBaseStep);
  }
}

/// Passes that each cross most of the tissue, if they are most of what was felt; otherwise none.
std::vector<Pass> rows_among(const std::vector<Pass>& passes, const std::vector<Vec3>& places) {
  const auto length_m = [&](const Pass& pass) {
    return (places[pass.back()] - places[pass.front()]).norm();
  };
  double longest_m = 0.0;
  for (const Pass& pass : passes) longest_m = std::max(longest_m, length_m(pass));
  std::vector<Pass> rows;
  std::size_t on_rows = 0;
  for (const Pass& pass : passes) {
    if (length_m(pass) < kAcross * longest_m || length_m(pass) < 2.0 * kTipWidth_m ||
        pass.size() < kLeastFrozen)
      continue;
    rows.push_back(pass);
    on_rows += pass.size();
  }
  const bool is_scan = rows.size() >= 2 && static_cast<double>(on_rows) >=
                                               kMostOfAll * static_cast<double>(places.size());
  return is_scan ? rows : std::vector<Pass>{};
}

/// What no tissue reads: far below all others, for tumours stand out upwards; or so far above them
/// that no stiffness would.
void find_gross(Screen& screen) {
  const std::vector<double> readings = used_readings(screen.palpations);
  if (readings.size() < kLeastToBeGross) return;
  const double low = quantile(readings, 0.05), high = quantile(readings, 0.95);
  if (!(high > low)) return;
  for (std::size_t i = 0; i < screen.palpations.size(); ++i) {
    const double reading = screen.palpations[i].reading;
    if (reading < low - kGrossBelow * (high - low) || reading > high + kGrossAbove * (high - low))
      screen.set_aside(i, kOutlier);
  }
}

}  // namespace

std::vector<Palpation> screened(const Surface& surface, std::span<const Palpation> palpations) {
  std::vector<Palpation> result(palpations.begin(), palpations.end());
  Screen screen{surface, result, {}};
  for (const Palpation& palpation : result)
    screen.places.push_back(surface.position(palpation.where));
  const std::vector<Pass> rows = rows_among(passes_of(screen.places), screen.places);
  find_frozen(screen);
  if (!rows.empty()) {
    find_flat_rows(screen, rows);
    const bool pokes = std::ranges::all_of(
        rows, [&](const Pass& row) { return median_step_m(screen.places, row) > kSliding_m; });
    find_levels_apart(screen, pokes);
    find_start_ups(screen, rows);
    find_parts_apart(screen, rows);
    find_transitions(screen, rows);
    find_base_steps(screen, rows);
  }
  find_gross(screen);
  for (std::size_t i : outliers(result, screen.places)) screen.set_aside(i, kOutlier);
  return result;
}

}  // namespace palpation
