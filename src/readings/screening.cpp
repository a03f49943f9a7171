#include "palpation/readings/screening.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <ranges>
#include <utility>

#include "readings/lost_contact.h"
#include "readings/outliers.h"
#include "readings/readings.h"
#include "readings/robust.h"
#include "readings/screen.h"

namespace palpation {
namespace {

// The probe of Garg et al. 2016, section VII: a tip 4.5 mm wide.
constexpr double kTipWidth_m = 0.0045;
constexpr std::size_t kLeastFrozen =
    8;  // readings: chance repeats the last digit of a plateau a few times
constexpr double kRareRun = 0.01;     // of chance, in all readings
constexpr double kAmongOthers = 0.3;  // of a run, where the probe goes to and fro
constexpr double kStepsBeside = 3.0;  // of a row, to the one beside it
constexpr double kAcross = 0.6;       // of the longest pass: a row that crosses most of the tissue
constexpr double kMostOfAll = 0.5;    // of all readings lie on rows, or it is no scan
constexpr std::size_t kLeastToBeGross = 20;
constexpr double kGrossBelow = 10.0;  // ranges of nine tenths of the readings
constexpr double kGrossAbove =
    1000.0;  // the same: a tumour stands out of noise of 0.1 % by three hundred

/// How often a reading repeats the one before it, but for those from `first` to `last`.
double repeats_without(const Screen& screen, std::size_t first, std::size_t last) {
  double pairs = 2.0, alike = 1.0;  // one of two beforehand
  for (std::size_t i = 1; i < screen.places.size(); ++i) {
    if (i >= first && i <= last + 1) continue;
    ++pairs;
    alike += screen.reading(i) == screen.reading(i - 1);
  }
  return alike / pairs;
}

/// Of those from `first` to `last` or of the others.
struct Nearest {
  std::optional<std::size_t> reading;
  double square = std::numeric_limits<double>::infinity();  // of how far it is
};
template <typename IsMeant>
Nearest nearest_to(const Screen& screen, std::size_t here, const IsMeant& is_meant) {
  Nearest nearest;
  for (std::size_t i = 0; i < screen.places.size(); ++i) {
    if (i == here || !is_meant(i)) continue;
    const double square = (screen.places[i] - screen.places[here]).squaredNorm();
    if (square < nearest.square) nearest = {i, square};
  }
  return nearest;
}

/// A run of one number, and what was felt around it at other times.
class Run {
 public:
  const std::size_t first, last;

  Run(const Screen& screen, std::size_t from, std::size_t to) : first(from), last(to) {
    const auto is_of_run = [&](std::size_t i) { return i >= first && i <= last; };
    for (std::size_t here = first; here <= last; ++here) {
      own_.push_back(nearest_to(screen, here, is_of_run));
      others_.push_back(nearest_to(screen, here, [&](std::size_t i) { return !is_of_run(i); }));
    }
  }

  std::ptrdiff_t size() const { return std::ssize(own_); }

  /// Part of it that lies nearer to what was made at another time.
  double among_others() const {
    double among = 0.0;
    for (std::size_t i = 0; i < own_.size(); ++i) among += others_[i].square < own_[i].square;
    return among / static_cast<double>(own_.size());
  }

  /// Whether most of it lies beside such readings, no farther than they may be.
  template <typename AreSuch>
  bool is_beside(const AreSuch& are_such, double farthest_m, double farthest_steps) const {
    std::size_t beside = 0;
    for (std::size_t i = 0; i < own_.size(); ++i) {
      const bool is_near =
          others_[i].square <=
          std::max(farthest_m * farthest_m, farthest_steps * farthest_steps * own_[i].square);
      beside += others_[i].reading && is_near && are_such(*others_[i].reading);
    }
    return 2 * beside > own_.size();
  }

 private:
  std::vector<Nearest> own_, others_;
};

/// At the end of the readings' range, and not far from those beside it: a plateau without noise, or
/// the limit of a sensor. One that hangs says so nowhere else, does not come to it and leave it by
/// a rise and a fall, and goes on so where all around is nearer to the other end.
bool ends_range(const Screen& screen, const std::vector<double>& sorted, double reading,
                const Run& run) {
  const double gap = kGapWidth * (sorted.back() - sorted.front());
  const auto [least, above] = std::ranges::equal_range(sorted, reading);
  const bool is_least = least == sorted.begin(), is_greatest = above == sorted.end();
  if (is_least == is_greatest) return false;
  const double to_next = is_least ? *above - *least : *least - *(least - 1);
  const double middle = 0.5 * (sorted.front() + sorted.back());
  const auto is_otherwise = [&](std::size_t i) {
    return (screen.reading(i) < middle) == is_greatest;
  };
  if (!(to_next < gap || run.among_others() < kAmongOthers)) return false;
  const bool is_felt_elsewhere = above - least > run.size();
  const bool is_crossed = run.last + 1 < screen.places.size() && run.first > 0 &&
                          !is_otherwise(run.first - 1) && !is_otherwise(run.last + 1);
  return is_felt_elsewhere || is_crossed || !run.is_beside(is_otherwise, kTipWidth_m, kStepsBeside);
}

/// Runs of one number while the probe moves, longer than a sensor with few steps makes by chance.
void find_frozen(Screen& screen) {
  std::vector<double> sorted = used_readings(screen.palpations);
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t first = 0, last = 0; first < screen.places.size(); first = last + 1) {
    double path_m = 0.0;
    for (last = first;
         last + 1 < screen.places.size() && screen.reading(last + 1) == screen.reading(first);
         ++last) {
      path_m += (screen.places[last + 1] - screen.places[last]).norm();
    }
    const auto run = std::views::iota(first, last + 1);
    const bool is_used = std::ranges::any_of(run, [&](std::size_t i) { return screen.uses(i); });
    if (run.size() < kLeastFrozen || path_m <= kTipWidth_m || !is_used) continue;
    const double by_chance = static_cast<double>(sorted.size()) *
                             std::pow(repeats_without(screen, first, last), last - first);
    if (by_chance > kRareRun) continue;
    const double reading = screen.reading(first);
    const Run around(screen, first, last);
    const auto is_alike = [&](std::size_t i) { return screen.reading(i) == reading; };
    constexpr double kAnywhere_m = std::numeric_limits<double>::infinity();
    if (ends_range(screen, sorted, reading, around) ||
        around.is_beside(is_alike, kAnywhere_m, 0.0))  // then it is the tissue that is so even
      continue;
    for (const std::size_t i : run) screen.set_aside(i, kFrozen);
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

void find_implausible(Screen& screen, double length_m) {
  find_gross(screen);
  for (std::size_t i : lost_contact(screen.palpations, screen.places))
    screen.set_aside(i, kNoContact);
  for (std::size_t i : outliers(screen.palpations, screen.places, length_m))
    screen.set_aside(i, kOutlier);
}

std::vector<Vec3> places_of(const Surface& surface, std::span<const Palpation> palpations) {
  std::vector<Vec3> places;
  for (const Palpation& palpation : palpations) places.push_back(surface.position(palpation.where));
  return places;
}

}  // namespace

std::vector<Palpation> plausible(const Surface& surface, std::span<const Palpation> palpations,
                                 double length_m) {
  std::vector<Palpation> result(palpations.begin(), palpations.end());
  Screen screen{result, places_of(surface, palpations)};
  find_implausible(screen, length_m);
  return result;
}

std::vector<Palpation> live(const Surface& surface, std::span<const Palpation> palpations) {
  std::vector<Palpation> result(palpations.begin(), palpations.end());
  // Where all are alike, so may tissue and sensor be.
  if (all_equal(used_readings(result))) return result;
  Screen screen{result, places_of(surface, palpations)};
  find_frozen(screen);
  find_another_unit(screen);
  return result;
}

std::vector<Palpation> screened(const Surface& surface, std::span<const Palpation> palpations) {
  std::vector<Palpation> result(palpations.begin(), palpations.end());
  Screen screen{result, places_of(surface, palpations)};
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
  find_implausible(screen, kShortLength_m);
  return result;
}

}  // namespace palpation
