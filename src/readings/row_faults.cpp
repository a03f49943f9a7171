#include <algorithm>
#include <cmath>
#include <optional>

#include "readings/robust.h"
#include "readings/screen.h"

namespace palpation {
namespace {

constexpr double kFlat = 0.05;        // of the rows' usual range: no contact, no change
constexpr double kStartUp_m = 0.003;  // after rest until the probe reads true
constexpr double kDense_m =
    0.0005;  // between readings: several to a millimetre, where tissue turns slowly ...
constexpr double kTurnShare = 0.05;  // ... by less than this part of a step at one reading
constexpr double kBaseShare =
    0.5;  // of the contrast: a row's base that steps as far as half a tumour

/// Low readings of a row: healthy tissue's.
double base_of(const std::vector<double>& row) { return quantile(row, 0.1); }
double range_of(const std::vector<double>& row) {
  return quantile(row, 0.95) - quantile(row, 0.05);
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

}  // namespace

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

void find_start_ups(Screen& screen, const std::vector<Pass>& rows) {
  const auto is_sliding = [&](const Pass& row) {
    return median_step_m(screen.places, row) <= kSliding_m;
  };
  std::vector<double> at_start, elsewhere;
  for (const Pass& row : rows) {
    if (!is_sliding(row)) continue;
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
    if (!is_sliding(row)) continue;
    for (std::size_t i : row) {
      if ((screen.places[i] - screen.places[row.front()]).norm() <= kStartUp_m)
        screen.set_aside(i, kStartUp);
    }
  }
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

}  // namespace palpation
