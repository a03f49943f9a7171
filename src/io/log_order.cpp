#include "io/log_order.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "palpation/base/error.h"
#include "probing/log_samples.h"

namespace palpation {
namespace {

constexpr double kSwapped = 10.5;  // sampling steps: rows that were written out of order
constexpr Eigen::Index kSwappedRows = 10;
constexpr double kNewClockGap = 100.0;  // sampling steps

std::vector<Eigen::Index> counted_up(Eigen::Index n) {
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(n));
  std::iota(rows.begin(), rows.end(), Eigen::Index{0});
  return rows;
}

/// Whether a clock that went back stays back: none of the next rows comes up to where it was.
bool stays_back(const RobotLog& log, Eigen::Index row, double latest_s, double shift_s) {
  const Eigen::Index end = std::min(log.size(), row + kSwappedRows);
  return (log.time_s.segment(row, end - row).array() + shift_s).maxCoeff() < latest_s;
}

/// Where the clock goes back by more than a swap: later stamps are moved on.
void mend_clock(RobotLog& log, double step_s, std::vector<std::string>& remarks) {
  double latest_s = log.time_s[0], shift_s = 0.0;
  int count = 0, first_line = 0;
  for (Eigen::Index i = 1; i < log.size(); ++i) {
    double here_s = log.time_s[i] + shift_s;
    if (here_s < latest_s - kSwapped * step_s && stays_back(log, i, latest_s, shift_s)) {
      shift_s += latest_s + kNewClockGap * step_s - here_s;
      here_s = log.time_s[i] + shift_s;
      if (count++ == 0) first_line = log.line[static_cast<std::size_t>(i)];
    }
    log.time_s[i] = here_s;
    latest_s = std::max(latest_s, here_s);
  }
  if (count > 0)
    remarks.push_back("The clock goes back " + std::to_string(count) +
                      (count == 1 ? " time" : " times") + ", first in line " +
                      std::to_string(first_line) +
                      ": what follows is taken as a new stretch, and its times are moved on.");
}

void sort_by(RobotLog& log, const std::vector<Eigen::Index>& order, const std::string& by,
             std::vector<std::string>& remarks) {
  int moved = 0, first_line = 0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (order[i] > order[i - 1]) continue;
    if (moved++ == 0) first_line = log.line[static_cast<std::size_t>(order[i])];
  }
  if (moved == 0) return;
  remarks.push_back("Rows were out of order at " + std::to_string(moved) +
                    (moved == 1 ? " place" : " places") + ", first at line " +
                    std::to_string(first_line) + ": they were sorted by " + by + ".");
  log = samples_of(log, order);
}

void tell_repeats(const RobotLog& log, std::vector<std::string>& remarks) {
  int count = 0, first_line = 0;
  for (Eigen::Index i = 1; i < log.size(); ++i)
    if (log.time_s[i] == log.time_s[i - 1] && count++ == 0)
      first_line = log.line[static_cast<std::size_t>(i)];
  if (count > 0)
    remarks.push_back(std::to_string(count) + (count == 1 ? " stamp repeats" : " stamps repeat") +
                      " the one before with other values, first in line " +
                      std::to_string(first_line) + ": all are kept.");
}

void tell_gaps(const RobotLog& log, double step_s, std::vector<std::string>& remarks) {
  int count = 0, first_line = 0;
  double longest_s = 0.0;
  for (Eigen::Index i = 1; i < log.size(); ++i) {
    const double gap_s = log.time_s[i] - log.time_s[i - 1];
    if (gap_s <= kSwapped * step_s) continue;
    if (count++ == 0) first_line = log.line[static_cast<std::size_t>(i)];
    longest_s = std::max(longest_s, gap_s);
  }
  if (count > 0 && log.probing.empty())
    remarks.push_back(std::to_string(count) + (count == 1 ? " gap" : " gaps") +
                      " in time, the longest of " + text_of(std::round(longest_s * 1e3) / 1e3) +
                      " s, the first before line " + std::to_string(first_line) + ".");
}

}  // namespace

std::vector<std::string> put_in_order(RobotLog& log, const Eigen::VectorXd& sample) {
  std::vector<std::string> remarks;
  std::vector<Eigen::Index> order = counted_up(log.size());
  if (log.time_s.size() > 0) {
    const double step_s = usual_step_s(log);
    mend_clock(log, step_s, remarks);
    std::stable_sort(order.begin(), order.end(),
                     [&](auto a, auto b) { return log.time_s[a] < log.time_s[b]; });
    sort_by(log, order, "time", remarks);
    tell_repeats(log, remarks);
    tell_gaps(log, step_s, remarks);
    return remarks;
  }
  if (sample.size() == 0 || log.probing.empty() || !sample.allFinite()) return remarks;
  // Samples of one probing lie together; the number counts within it.
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first + 1;
    while (end < order.size() && log.probing[end] == log.probing[first]) ++end;
    std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(first),
                     order.begin() + static_cast<std::ptrdiff_t>(end),
                     [&](auto a, auto b) { return sample[a] < sample[b]; });
    first = end;
  }
  sort_by(log, order, "sample", remarks);
  return remarks;
}

}  // namespace palpation
