#include "palpation/probing/scan.h"

#include <algorithm>
#include <cmath>

#include "palpation/base/error.h"
#include "probing/log_samples.h"
#include "probing/robust.h"

namespace palpation {
namespace {

constexpr double kJump_m = 0.005;
constexpr double kGapSteps = 5.5;
constexpr std::size_t kLeastStuckPokes = 5;
constexpr double kMostCorrelation = 0.4;  // beyond, a stretch is too short to show the noise

/// Samples that become one reading.
struct Stroke {
  std::vector<Eigen::Index> rows;
  double way_m = 0.0;
};

Eigen::VectorXd one_force(const RobotLog& log) {
  return log.force_along.size() > 0 ? log.force_along : Eigen::VectorXd(log.force.rowwise().norm());
}

bool breaks(const RobotLog& log, Eigen::Index before, Eigen::Index row, double gap_s) {
  const auto a = static_cast<std::size_t>(before), b = static_cast<std::size_t>(row);
  if (!log.probing.empty() && log.probing[a] != log.probing[b]) return true;
  if (!log.session.empty() && log.session[a] != log.session[b]) return true;
  if (log.time_s.size() > 0 && !(log.time_s[row] - log.time_s[before] <= gap_s)) return true;
  return (log.position_m.row(row) - log.position_m.row(before)).norm() > kJump_m;
}

std::vector<Stroke> strokes_of(const RobotLog& log, const Eigen::VectorXd& force, double every_m) {
  const double gap_s = log.time_s.size() > 0 ? kGapSteps * usual_step_s(log) : 0.0;
  std::vector<Stroke> strokes;
  Eigen::Index before = -1;
  for (Eigen::Index row = 0; row < log.size(); ++row) {
    if (!std::isfinite(force[row]) || !log.position_m.row(row).allFinite()) continue;
    const double step_m =
        before < 0 ? 0.0 : (log.position_m.row(row) - log.position_m.row(before)).norm();
    if (before < 0 || breaks(log, before, row, gap_s) || strokes.back().way_m + step_m > every_m)
      strokes.push_back({{}, 0.0});
    else
      strokes.back().way_m += step_m;
    strokes.back().rows.push_back(row);
    before = row;
  }
  return strokes;
}

/// What is left of a stroke's samples about a line in their order.
Eigen::VectorXd residuals_of(const Eigen::VectorXd& values) {
  const auto n = static_cast<double>(values.size());
  const Eigen::VectorXd at =
      Eigen::VectorXd::LinSpaced(values.size(), -0.5 * (n - 1.0), 0.5 * (n - 1.0));
  const double slope = at.dot(values) / at.squaredNorm();
  return values.array() - values.mean() - slope * at.array();
}

/// Of the errors of neighbouring samples, over all strokes of five samples or more. Steps from one
/// sample to the next know nothing of the field's slope; those of white noise go against each
/// other, by one half, those of errors that follow each other do not: r = 1 + 2 corr.
double neighbour_correlation(const std::vector<Stroke>& strokes, const Eigen::VectorXd& force) {
  double products = 0.0, squares = 0.0;
  for (const Stroke& stroke : strokes) {
    const auto n = static_cast<Eigen::Index>(stroke.rows.size());
    if (n < 5) continue;
    const Eigen::VectorXd values = force(stroke.rows);
    const double slope = (values[n - 1] - values[0]) / double(n - 1);
    const Eigen::VectorXd steps = (values.tail(n - 1) - values.head(n - 1)).array() - slope;
    products += steps.head(n - 2).dot(steps.tail(n - 2)) / double(n - 2);
    squares += steps.squaredNorm() / double(n - 1);
  }
  return squares > 0.0 ? std::clamp(1.0 + 2.0 * products / squares, 0.0, 1.0) : 0.0;
}

bool is_stuck(const Stroke& stroke, const Eigen::VectorXd& force, double every_m) {
  if (stroke.rows.size() < 3 || stroke.way_m < 0.5 * every_m) return false;
  return std::all_of(stroke.rows.begin(), stroke.rows.end(),
                     [&](Eigen::Index row) { return force[row] == force[stroke.rows[0]]; });
}

/// Pokes in a row that all hold one value: the sensor hung.
void mark_stuck_pokes(const std::vector<Stroke>& strokes, const Eigen::VectorXd& force,
                      std::vector<Probed>& probed) {
  const auto value = [&](std::size_t i) { return force[strokes[i].rows[0]]; };
  for (std::size_t first = 0; first < strokes.size();) {
    std::size_t end = first + 1;
    while (end < strokes.size() && value(end) == value(first)) ++end;
    for (std::size_t i = first; end - first >= kLeastStuckPokes && i < end; ++i)
      if (strokes[i].rows.size() == 1) probed[i].reason = "the sensor is stuck at one value";
    first = end;
  }
}

Probed probed_of(const RobotLog& log, const Eigen::VectorXd& force, const Stroke& stroke,
                 double correlation) {
  const std::vector<Eigen::Index>& rows = stroke.rows;
  const auto first = static_cast<std::size_t>(rows.front());
  Probed probed;
  probed.place_m = log.position_m(rows, Eigen::all).colwise().mean();
  probed.reading = force(rows).mean();
  const Vec3 step = log.position_m.row(rows.back()) - log.position_m.row(rows.front());
  if (rows.size() > 1 && step.norm() > 0.0) probed.travel = step.normalized();
  if (log.time_s.size() > 0) probed.time_s = log.time_s(rows).mean();
  if (log.normal.rows() > 0) {
    const Vec3 normal = log.normal(rows, Eigen::all).colwise().mean();
    if (normal.allFinite() && normal.norm() > 0.0) probed.normal = normal.normalized();
  }
  if (!log.session.empty()) probed.session = log.session[first];
  if (!log.probing.empty())
    probed.probing = log.names[static_cast<std::size_t>(log.probing[first])];
  probed.contact = "sliding";
  probed.line = log.line[first];
  const int degrees = static_cast<int>(rows.size()) - 2;
  if (degrees < 3 || correlation > kMostCorrelation) return probed;
  const double following = (1.0 + correlation) / (1.0 - correlation);
  probed.noise_variance = student_variance(residuals_of(force(rows)).squaredNorm(), degrees) *
                          following / double(rows.size());
  return probed;
}

}  // namespace

ProbedLog scan_readings(const RobotLog& log, const ScanOptions& options) {
  const Eigen::Index n = log.size();
  require(
      n > 0 && log.position_m.rows() == n && (log.force.rows() == n || log.force_along.size() == n),
      "scan_readings", "the log", "must have samples, each with position and force or count");
  require(std::isfinite(options.every_m) && options.every_m > 0.0, "scan_readings",
          text_of(options.every_m) + " m a reading", "must be positive and finite");
  const Eigen::VectorXd force = one_force(log);
  const std::vector<Stroke> strokes = strokes_of(log, force, options.every_m);
  const double correlation = neighbour_correlation(strokes, force);
  ProbedLog result;
  result.unit = log.force_unit;
  for (const Stroke& stroke : strokes) {
    result.probed.push_back(probed_of(log, force, stroke, correlation));
    Probed& last = result.probed.back();
    if (last.probing.empty()) last.probing = std::to_string(result.probed.size());
    if (is_stuck(stroke, force, options.every_m)) last.reason = "the sensor is stuck at one value";
  }
  mark_stuck_pokes(strokes, force, result.probed);
  for (Probed& one : result.probed)
    if (!one.reason.empty()) one.reading = one.noise_variance = std::nan("");
  result.remarks.push_back("A reading for each " + text_of(options.every_m * 1e3) +
                           " mm of travel, or for each sample where they lie farther apart.");
  if (correlation > kMostCorrelation)
    result.remarks.push_back(
        "Its samples follow each other closely (correlation " +
        text_of(std::round(correlation * 100.0) / 100.0) +
        "), as a filter's do: they do not tell their noise, and noise_variance is left empty.");
  return result;
}

}  // namespace palpation
