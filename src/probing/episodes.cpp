// Which samples make a probing: by the log's names, or by contact.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "palpation/base/error.h"
#include "palpation/probing/probings.h"
#include "probing/log_samples.h"
#include "probing/robust.h"

namespace palpation {
namespace {

constexpr double kShareOfPeak = 0.1;
constexpr double kNoises = 6.0;
constexpr int kRounds = 8;  // of fitting the sensor's zero: it settles in three or four
constexpr Eigen::Index kLeastEpisode = 3;
constexpr Eigen::Index kSwappedRows = 5;  // of other probings in between
constexpr std::size_t kLeastVisit = 3;
constexpr double kAirBefore = 2.0;     // samples in the air for each in contact, at most
constexpr double kSilentSteps = 10.5;  // of time: not recorded in between
constexpr double kJump = 5.0;          // of the longest step in contact: from another place

/// Samples of one name and session make one probing, rows that were swapped with others' too; but
/// where a few or more lie to both sides of others', the robot came back.
std::vector<std::vector<Eigen::Index>> by_name(const RobotLog& log) {
  std::map<std::pair<std::string, int>, std::vector<Eigen::Index>> named;
  for (Eigen::Index i = 0; i < log.size(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    named[{log.session.empty() ? std::string() : log.session[row], log.probing[row]}].push_back(i);
  }
  std::vector<std::vector<Eigen::Index>> groups;
  for (const auto& [name, rows] : named) {
    std::size_t first = 0;
    for (std::size_t i = 1; i <= rows.size(); ++i) {
      const bool comes_back = i < rows.size() && rows[i] - rows[i - 1] > kSwappedRows &&
                              i - first >= kLeastVisit && rows.size() - i >= kLeastVisit;
      if (i < rows.size() && !comes_back) continue;
      groups.emplace_back(rows.begin() + static_cast<std::ptrdiff_t>(first),
                          rows.begin() + static_cast<std::ptrdiff_t>(i));
      first = i;
    }
  }
  std::sort(groups.begin(), groups.end());
  return groups;
}

/// The force as one number a sample: its own, or its component along which it changes most; larger
/// in contact, which is the rarer and the farther from the middle.
Eigen::VectorXd one_force(const RobotLog& log) {
  Eigen::VectorXd force = log.force_along;
  if (log.force.rows() > 0) {
    std::vector<Eigen::Index> rows;
    for (Eigen::Index i = 0; i < log.size(); ++i)
      if (log.force.row(i).allFinite()) rows.push_back(i);
    Points finite = log.force(rows, Eigen::all);
    finite.rowwise() -= finite.colwise().mean().eval();
    const Eigen::Matrix3d spread = finite.transpose() * finite;
    force =
        log.force * Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
  }
  std::vector<double> values;
  for (const double value : force)
    if (std::isfinite(value)) values.push_back(value);
  const double middle = median_of(values);
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  if (!values.empty() && middle - *least > *most - middle) force = -force;
  return force;
}

/// Fits a line in time to the samples that do not stand over it: the sensor's zero, and what is
/// over it.
Eigen::VectorXd over_zero(const Eigen::VectorXd& force, double& noise) {
  const Eigen::Index n = force.size();
  std::vector<double> values(force.begin(), force.end());
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  std::sort(values.begin(), values.end());
  double zero = values[values.size() / 5], slope = 0.0;
  noise = std::max(zero - values.front(), 1e-3 * (values.back() - values.front()));
  const auto line = [&](Eigen::Index i) { return zero + slope * (double(i) - 0.5 * double(n)); };
  for (int round = 0; round < kRounds; ++round) {
    double count = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (!(force[i] - line(i) <= 3.0 * noise)) continue;
      const double at = double(i) - 0.5 * double(n);
      ++count, x += at, y += force[i], xx += at * at, xy += at * force[i];
    }
    const double spread = xx - x * x / std::max(1.0, count);
    if (count < 5.0 || !(spread > 0.0)) break;
    slope = (xy - x * y / count) / spread;
    zero = (y - slope * x) / count;
    std::vector<double> left;
    for (Eigen::Index i = 0; i < n; ++i)
      if (force[i] - line(i) <= 3.0 * noise) left.push_back(std::abs(force[i] - line(i)));
    noise = std::max(1.4826 * median_of(left), 1e-4 * (values.back() - values.front()));
  }
  Eigen::VectorXd over(n);
  for (Eigen::Index i = 0; i < n; ++i) over[i] = force[i] - line(i);
  return over;
}

/// Runs of samples above the threshold; what is not a number breaks none.
std::vector<std::vector<Eigen::Index>> contacts_in(const Eigen::VectorXd& over, double threshold) {
  std::vector<std::vector<Eigen::Index>> runs;
  bool in_contact = false;
  for (Eigen::Index i = 0; i < over.size(); ++i) {
    if (std::isnan(over[i])) continue;
    const bool touches = over[i] > (in_contact ? 0.5 * threshold : threshold);
    if (touches && !in_contact) runs.emplace_back();
    if (touches) runs.back().push_back(i);
    in_contact = touches;
  }
  std::erase_if(
      runs, [](const auto& run) { return static_cast<Eigen::Index>(run.size()) < kLeastEpisode; });
  return runs;
}

/// The first row of an approach that hangs together up to contact: in time, and in space.
Eigen::Index begin_of_approach(const RobotLog& log, double usual_s, Eigen::Index start,
                               Eigen::Index first, Eigen::Index last) {
  if (log.position_m.rows() == 0) return start;
  const auto step_m = [&](Eigen::Index i) {
    return (log.position_m.row(i) - log.position_m.row(i - 1)).norm();
  };
  double longest_m = 0.0;
  for (Eigen::Index i = first + 1; i <= last; ++i)
    if (step_m(i) > longest_m) longest_m = step_m(i);
  for (Eigen::Index i = first; i > start; --i) {
    if (step_m(i) > kJump * longest_m) return i;
    if (log.time_s.size() > 0 && log.time_s[i] - log.time_s[i - 1] > kSilentSteps * usual_s)
      return i;
  }
  return start;
}

std::vector<std::vector<Eigen::Index>> by_contact(const RobotLog& log) {
  const Eigen::VectorXd force = one_force(log);
  if (!(force.array() == force.array()).any()) return {};
  double noise = 0.0;
  const Eigen::VectorXd over = over_zero(force, noise);
  std::vector<double> sorted;
  for (const double value : over)
    if (std::isfinite(value)) sorted.push_back(value);
  std::sort(sorted.begin(), sorted.end());
  const double peak = sorted[static_cast<std::size_t>(0.98 * double(sorted.size() - 1))];
  std::vector<std::vector<Eigen::Index>> groups =
      contacts_in(over, std::max(kNoises * noise, kShareOfPeak * peak));
  const double usual_s = log.time_s.size() > 0 ? usual_step_s(log) : 0.0;
  Eigen::Index free_from = 0;
  for (std::vector<Eigen::Index>& group : groups) {
    const Eigen::Index first = group.front(), last = group.back();
    const auto most = static_cast<Eigen::Index>(kAirBefore * double(group.size())) + 5;
    const Eigen::Index halfway = free_from == 0 ? 0 : free_from + (first - free_from) / 2;
    const Eigen::Index start =
        begin_of_approach(log, usual_s, std::max(halfway, first - most), first, last);
    group.clear();
    for (Eigen::Index i = start; i <= last; ++i) group.push_back(i);
    free_from = last + 1;
  }
  return groups;
}

}  // namespace

std::vector<std::vector<Eigen::Index>> probings_in(const RobotLog& log) {
  return log.probing.empty() ? by_contact(log) : by_name(log);
}

}  // namespace palpation
