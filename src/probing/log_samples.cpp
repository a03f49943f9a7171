#include "probing/log_samples.h"

#include <cmath>

#include "probing/robust.h"

namespace palpation {

double usual_step_s(const RobotLog& log) {
  std::vector<double> steps;
  for (Eigen::Index i = 1; i < log.time_s.size(); ++i) {
    const double step = log.time_s[i] - log.time_s[i - 1];
    if (step > 0.0) steps.push_back(step);
  }
  return median_of(std::move(steps));
}

std::vector<Stretch> stretches_in_time(const RobotLog& log, double gap_s) {
  std::vector<Stretch> stretches;
  for (Eigen::Index i = 0; i < log.size(); ++i) {
    const bool goes_on = i > 0 && log.time_s[i] >= log.time_s[i - 1] &&
                         log.time_s[i] - log.time_s[i - 1] <= gap_s &&
                         (log.session.empty() || log.session[static_cast<std::size_t>(i)] ==
                                                     log.session[static_cast<std::size_t>(i - 1)]);
    if (!goes_on) stretches.push_back({i, i});
    stretches.back().last = i;
  }
  return stretches;
}

RobotLog finite_samples(const RobotLog& log) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < log.size(); ++i) {
    const bool is_finite = (log.time_s.size() == 0 || std::isfinite(log.time_s[i])) &&
                           (log.position_m.rows() == 0 || log.position_m.row(i).allFinite()) &&
                           (log.force.rows() == 0 || log.force.row(i).allFinite()) &&
                           (log.force_along.size() == 0 || std::isfinite(log.force_along[i]));
    if (is_finite) rows.push_back(i);
  }
  return samples_of(log, rows);
}

RobotLog samples_of(const RobotLog& log, const std::vector<Eigen::Index>& rows) {
  RobotLog some;
  const auto vector = [&](const Eigen::VectorXd& values) {
    return values.size() == 0 ? Eigen::VectorXd() : Eigen::VectorXd(values(rows));
  };
  const auto points = [&](const Points& values) {
    return values.rows() == 0 ? Points(0, 3) : Points(values(rows, Eigen::all));
  };
  some.time_s = vector(log.time_s);
  some.position_m = points(log.position_m);
  some.depth_m = vector(log.depth_m);
  some.force = points(log.force);
  some.force_along = vector(log.force_along);
  some.normal = points(log.normal);
  some.contact_m = points(log.contact_m);
  some.names = log.names;
  some.force_unit = log.force_unit;
  for (const Eigen::Index row : rows) {
    const auto i = static_cast<std::size_t>(row);
    some.line.push_back(log.line[i]);
    if (!log.probing.empty()) some.probing.push_back(log.probing[i]);
    if (!log.session.empty()) some.session.push_back(log.session[i]);
  }
  return some;
}

}  // namespace palpation
