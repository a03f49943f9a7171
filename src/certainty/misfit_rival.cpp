#include "certainty/misfit_rival.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace palpation {

ExplainedReadings::ExplainedReadings(const Surface& on, const EdgeFit& edge,
                                     const EdgeData& readings, const EdgeProfile& profile,
                                     double weight)
    : surface(on),
      fit(edge),
      data(readings),
      log_weight(std::log(weight)),
      low(profile.low),
      contrast(profile.high - profile.low),
      depth(readings.depth_m + edge.correction_m),
      share(depth.unaryExpr([&](double at) { return profile_share(edge.profile, at); })),
      residual(edge.covariance.matrixL() * Eigen::VectorXd(edge.covariance.matrixU() * edge.pull)),
      pull(edge.pull) {}

Eigen::VectorXd ExplainedReadings::solve(const Eigen::VectorXd& column) const {
  Eigen::VectorXd solved = fit.covariance.solve(column);
  for (const Eigen::VectorXd& known : also) solved -= known * known.dot(column);
  return solved;
}

void ExplainedReadings::add(const Eigen::VectorXd& column) {
  const Eigen::VectorXd solved = kPart * solve(column);
  also.push_back(solved / std::sqrt(1.0 + kPart * column.dot(solved)));
  pull -= also.back() * also.back().dot(residual);
}

Misfit weighed(const ExplainedReadings& rows, const Eigen::VectorXd& column, Misfit rival) {
  const double before = rows.residual.dot(rows.pull), b = column.dot(rows.pull);
  const double a = kPart * kPart * column.dot(rows.solve(column));
  const double after = before - kPart * kPart * b * b / (1.0 + a);
  rival.evidence = after > 0.0
                       ? rows.log_weight +
                             0.5 * static_cast<double>(column.size()) * std::log(before / after) -
                             0.5 * std::log1p(a)
                       : -std::numeric_limits<double>::infinity();
  rival.amount *= kPart * kPart * b / (1.0 + a);
  return rival;
}

Eigen::VectorXd part_since(const EdgeData& data, const Misfit& change) {
  Eigen::VectorXd part(static_cast<Eigen::Index>(data.made.size()));
  for (std::size_t i = 0; i < data.made.size(); ++i) {
    const std::vector<Made>& made = data.made[i];
    const auto since =
        std::ranges::count_if(made, [&](const Made& one) { return is_since(change, one); });
    part[static_cast<Eigen::Index>(i)] =
        static_cast<double>(since) / static_cast<double>(made.size());
  }
  return part;
}

void RivalKind::add(Misfit rival) {
  factors_.add(rival.evidence);
  if (std::isfinite(rival.evidence) && (!best_ || rival.evidence > best_->evidence))
    best_ = std::move(rival);
}

void RivalKind::weigh(const ExplainedReadings& rows, const Eigen::VectorXd& column, Misfit rival) {
  add(weighed(rows, column, std::move(rival)));
}

double RivalKind::strongest() const {
  return best_ ? best_->evidence : -std::numeric_limits<double>::infinity();
}

std::optional<Misfit> RivalKind::verdict() const {
  if (!best_) return std::nullopt;
  Misfit misfit = *best_;
  misfit.evidence = factors_.value();
  return misfit;
}

}  // namespace palpation
