#include "belief/regression.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace palpation {

Regression::Regression(const ScaledPrior& field, const Whitened& whitened)
    : has_slope_(field.prior.has_slope()), origin_(whitened.origin) {
  fit_constant(field, whitened);
  const double signal_sd = field.prior.kernel().signal_sd;
  if (has_slope_) fit_slope(signal_sd * signal_sd, whitened);
}

/// Prior N(centre, sd^2) and L^-1 (y - c) white.
void Regression::fit_constant(const ScaledPrior& field, const Whitened& whitened) {
  const double prior_sd = field.constant_sd();
  if (prior_sd == 0.0) {
    constant_precision_ = std::numeric_limits<double>::infinity();
    constant_ = field.centre;
    return;
  }
  const double ratio = field.signal_sd() / prior_sd;
  const double prior_precision = ratio * ratio;
  constant_precision_ = prior_precision + whitened.ones.squaredNorm();
  constant_ = constant_precision_ > 0.0 ? origin_ + (prior_precision * (field.centre - origin_) +
                                                     whitened.ones.dot(whitened.readings)) /
                                                        constant_precision_
                                        : field.centre;
}

bool Regression::constant_is_unsure() const {
  return std::isfinite(constant_precision_) && constant_precision_ > 0.0;
}

/// `precision` I + W'W - W'1 1'W / (the constant's precision), W the whitened tilts and `precision`
/// of a prior of unit variance over the signal's.
void Regression::fit_slope(double precision, const Whitened& whitened) {
  const Tilts& tilts = whitened.tilts;
  const Vec3 along_ones = tilts.transpose() * whitened.ones;
  constant_per_tilt_ =
      constant_is_unsure() ? Vec3(along_ones / constant_precision_) : Vec3(Vec3::Zero());
  Eigen::Matrix3d posterior =
      tilts.transpose() * tilts - along_ones * constant_per_tilt_.transpose();
  posterior.diagonal().array() += precision;
  tilt_covariance_ = posterior.llt().solve(Eigen::Matrix3d::Identity());
  tilt_ = tilt_covariance_ *
          (tilts.transpose() * (whitened.readings - (constant_ - origin_) * whitened.ones));
}

Vec3 Regression::tilt_residual(const Vec3& tilt, const Vec3& v_tilts, double residual_ones,
                               Part part) const {
  const Vec3 of_component = -v_tilts - residual_ones * constant_per_tilt_;
  return part == Part::Detrended ? of_component : Vec3(tilt + of_component);
}

Evidence Regression::integrated_out(const ScaledPrior& field, const Whitened& whitened,
                                    double log_determinant) const {
  const double prior_sd = field.constant_sd(), signal_variance = field.signal_variance();
  Evidence left{.log_determinant = log_determinant};
  if (std::isinf(prior_sd)) {
    left.square = (whitened.readings - (constant_ - origin_) * whitened.ones).squaredNorm();
    left.log_determinant += std::log(constant_precision_ / signal_variance);
    left.free_readings = -1.0;
  } else {
    const Eigen::VectorXd centred = whitened.readings - (field.centre - origin_) * whitened.ones;
    left.square = centred.squaredNorm();
    if (prior_sd > 0.0) {
      const double projection = centred.dot(whitened.ones);
      left.square -= projection * projection / constant_precision_;
      left.log_determinant += std::log(constant_precision_ * prior_sd * prior_sd / signal_variance);
    }
  }
  if (has_slope_) {
    const double signal_sd = field.prior.kernel().signal_sd;
    left.square -= tilt_.dot(tilt_covariance_.inverse() * tilt_);
    left.log_determinant -=
        std::log(tilt_covariance_.determinant()) + 3.0 * std::log(signal_sd * signal_sd);
  }
  return left;
}

}  // namespace palpation
