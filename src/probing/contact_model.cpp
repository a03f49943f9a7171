#include "probing/contact_model.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

namespace palpation {
namespace {

constexpr int kGridSteps = 80;
constexpr int kGoldenSteps = 40;
constexpr double kGolden = 0.6180339887498949;
constexpr double kIndistinct = 1e-9;  // of the largest singular value, columns scaled to one length

int own_count(ContactModel model) { return model == ContactModel::ForceAtDepth ? 2 : 1; }

/// What turns Hertz's E* into the coefficient of u^(3/2).
double hertz_factor(const ContactOptions& options) {
  return 4.0 / 3.0 * std::sqrt(options.indenter_radius_m);
}

Eigen::VectorXd past(const Loading& loading, double contact_depth_m) {
  return (loading.depth_m.array() - contact_depth_m).cwiseMax(0.0);
}

Eigen::MatrixXd basis_at(const Loading& loading, const ContactOptions& options,
                         const Unknowns& unknowns, double contact_depth_m) {
  const Eigen::VectorXd u = past(loading, contact_depth_m);
  Eigen::MatrixXd basis(u.size(), before_own(unknowns) + own_count(options.model));
  int column = 0;
  if (unknowns.zero) basis.col(column++).setOnes();
  if (unknowns.drift) basis.col(column++) = loading.time_s.array() - loading.time_s.mean();
  switch (options.model) {
    case ContactModel::Linear:
      basis.col(column) = u;
      break;
    case ContactModel::Hertz:
      basis.col(column) = hertz_factor(options) * u.array() * u.array().sqrt();
      break;
    case ContactModel::ForceAtDepth:
      basis.col(column) = u;
      basis.col(column + 1) = u.array().square();
      break;
  }
  return basis;
}

/// The derivative of the model's force by the contact depth.
Eigen::VectorXd by_contact(const Loading& loading, const ContactOptions& options,
                           const Unknowns& unknowns, double contact_depth_m,
                           const Eigen::VectorXd& coefficients) {
  const Eigen::ArrayXd u = past(loading, contact_depth_m);
  const Eigen::ArrayXd inside = (u > 0.0).cast<double>();
  const int own = before_own(unknowns);
  switch (options.model) {
    case ContactModel::Linear:
      return -coefficients[own] * inside;
    case ContactModel::Hertz:
      return -coefficients[own] * hertz_factor(options) * 1.5 * u.sqrt();
    case ContactModel::ForceAtDepth:
      break;
  }
  return -(coefficients[own] * inside + 2.0 * coefficients[own + 1] * u);
}

/// By all unknowns; the contact depth's column is the last.
Eigen::MatrixXd derivatives_at(const Loading& loading, const ContactOptions& options,
                               const Unknowns& unknowns, double contact_depth_m,
                               const LinearFit& fit) {
  Eigen::MatrixXd derivatives = basis_at(loading, options, unknowns, contact_depth_m);
  if (!unknowns.contact) return derivatives;
  derivatives.conservativeResize(Eigen::NoChange, derivatives.cols() + 1);
  derivatives.rightCols(1) =
      by_contact(loading, options, unknowns, contact_depth_m, fit.coefficients);
  return derivatives;
}

/// Columns of one length each, so that metres beside one do not pass for indistinct.
Eigen::VectorXd lengths_of(const Eigen::MatrixXd& columns) {
  Eigen::VectorXd lengths = columns.colwise().norm();
  for (double& length : lengths) length = length > 0.0 ? length : 1.0;
  return lengths;
}

}  // namespace

int before_own(const Unknowns& unknowns) { return int(unknowns.zero) + int(unknowns.drift); }

int unknown_count(const ContactOptions& options, const Unknowns& unknowns) {
  return before_own(unknowns) + own_count(options.model) + int(unknowns.contact);
}

LinearFit fit_at(const Loading& loading, const ContactOptions& options, const Unknowns& unknowns,
                 double contact_depth_m) {
  const Eigen::MatrixXd basis = basis_at(loading, options, unknowns, contact_depth_m);
  const Eigen::VectorXd lengths = lengths_of(basis);
  const Eigen::MatrixXd scaled = basis * lengths.cwiseInverse().asDiagonal();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(scaled);
  solver.setThreshold(kIndistinct);
  LinearFit fit;
  fit.coefficients = solver.solve(loading.force).cwiseQuotient(lengths);
  fit.residuals = loading.force - basis * fit.coefficients;
  fit.squares = fit.residuals.squaredNorm();
  return fit;
}

double best_contact(const Loading& loading, const ContactOptions& options, const Unknowns& unknowns,
                    double least_m, double most_m) {
  const auto squares = [&](double depth_m) {
    return fit_at(loading, options, unknowns, depth_m).squares;
  };
  double best_m = least_m, best = std::numeric_limits<double>::infinity();
  const double step_m = (most_m - least_m) / kGridSteps;
  for (int i = 0; i <= kGridSteps; ++i) {
    const double here = squares(least_m + i * step_m);
    if (here >= best) continue;
    best = here;
    best_m = least_m + i * step_m;
  }
  double low_m = std::max(best_m - step_m, least_m), high_m = std::min(best_m + step_m, most_m);
  for (int i = 0; i < kGoldenSteps; ++i) {
    const double left_m = high_m - kGolden * (high_m - low_m);
    const double right_m = low_m + kGolden * (high_m - low_m);
    (squares(left_m) <= squares(right_m) ? high_m : low_m) =
        squares(left_m) <= squares(right_m) ? right_m : left_m;
  }
  const double middle_m = 0.5 * (low_m + high_m);
  return squares(middle_m) <= best ? middle_m : best_m;
}

Value value_of(const Loading& loading, const ContactOptions& options, const Unknowns& unknowns,
               double contact_depth_m, const LinearFit& fit) {
  Eigen::MatrixXd derivatives = derivatives_at(loading, options, unknowns, contact_depth_m, fit);
  // The value is a sum of the model's own coefficients: one, or the force at a depth; the zero of a
  // sensor that cannot be told from the first force belongs to that.
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(derivatives.cols());
  const int own = before_own(unknowns);
  const double h = options.at_depth_m;
  weights[own] = options.model == ContactModel::ForceAtDepth ? h : 1.0;
  if (options.model == ContactModel::ForceAtDepth) {
    weights[own + 1] = h * h;
    if (!unknowns.contact) weights[0] = 1.0;
  }
  const Eigen::VectorXd lengths = lengths_of(derivatives);
  derivatives = derivatives * lengths.cwiseInverse().asDiagonal();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(derivatives);
  solver.setThreshold(kIndistinct);
  Value value;
  value.value = weights.head(fit.coefficients.size()).dot(fit.coefficients);
  value.unit_variance = std::numeric_limits<double>::quiet_NaN();
  if (solver.rank() < derivatives.cols()) return value;
  const Eigen::VectorXd scaled =
      solver.colsPermutation().transpose() * weights.cwiseQuotient(lengths);
  const auto triangle = solver.matrixR()
                            .topLeftCorner(derivatives.cols(), derivatives.cols())
                            .template triangularView<Eigen::Upper>();
  value.unit_variance = triangle.transpose().solve(scaled).squaredNorm();
  return value;
}

Eigen::VectorXd leverages_of(const Loading& loading, const ContactOptions& options,
                             const Unknowns& unknowns, double contact_depth_m,
                             const LinearFit& fit) {
  Eigen::MatrixXd derivatives = derivatives_at(loading, options, unknowns, contact_depth_m, fit);
  derivatives = derivatives * lengths_of(derivatives).cwiseInverse().asDiagonal();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(derivatives);
  solver.setThreshold(kIndistinct);
  const Eigen::MatrixXd orthonormal =
      solver.householderQ() * Eigen::MatrixXd::Identity(derivatives.rows(), solver.rank());
  return orthonormal.rowwise().squaredNorm();
}

}  // namespace palpation
