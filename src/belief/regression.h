/// The constant and the slope of the field, one regression on h(x) = (1, t(x)), t what a slope of
/// one standard deviation along each coordinate adds (Prior::tilt):
///
///     f(x) = h(x).b + g(x),   b ~ N((centre, 0), diag(sd^2, I)),   b | y from L^-1 y and L^-1 h,
///     residual(x) = h(x) - (L^-1 h)' v(x),   v = L^-1 k(sites, x).
///
/// By blocks, the constant first and the slope from what it leaves (Schur's complement): a constant
/// that is not known at all is a precision of zero and no large number. Variances are over the
/// signal's.
#pragma once

#include "belief/scaled_prior.h"
#include "belief/tilts.h"

namespace palpation {

/// L^-1 of the regression's right sides, a row a site, or rows whose inner products are the same.
struct Whitened {
  Eigen::VectorXd ones;      // of 1
  Eigen::VectorXd readings;  // of y - origin
  Tilts tilts;               // of t at the sites; empty where there is no slope
  double origin = 0.0;
};

/// What integrating out leaves of log likelihood.
struct Evidence {
  double square = 0.0;           // (y - h.b)' (K + D)^-1 (y - h.b), over the signal's variance
  double log_determinant = 0.0;  // of K + D in reading units, and of b's precision over its prior's
  double free_readings = 0.0;
};

class Regression {
 public:
  Regression(const ScaledPrior& field, const Whitened& whitened);

  bool has_slope() const { return has_slope_; }
  double constant() const { return constant_; }
  /// Posterior mean of the slope, in standard deviations of its prior.
  const Vec3& tilt() const { return tilt_; }

  /// The mean of c + g where v'L^-1 1 and v'L^-1 (y - origin) are these.
  double mean(double ones, double readings) const {
    return constant_ + (readings - (constant_ - origin_) * ones);
  }
  /// The value times the variance of the constant: 0 where that is known, or nothing is known.
  double times_constant_variance(double value) const {
    return constant_is_unsure() ? value / constant_precision_ : 0.0;
  }

  /// Of the slope, at a place with this tilt, where v'L^-1 t is `v_tilts` and 1 - v'L^-1 1
  /// `residual_ones`.
  Vec3 tilt_residual(const Vec3& tilt, const Vec3& v_tilts, double residual_ones, Part part) const;
  /// That times the covariance of the slope.
  Vec3 tilt_weights(const Vec3& residual) const { return tilt_covariance_ * residual; }

  /// With log_determinant that of K + D in reading units.
  Evidence integrated_out(const ScaledPrior& field, const Whitened& whitened,
                          double log_determinant) const;

 private:
  bool constant_is_unsure() const;
  void fit_constant(const ScaledPrior& field, const Whitened& whitened);
  void fit_slope(double precision, const Whitened& whitened);

  bool has_slope_;
  double origin_;
  double constant_precision_ = 0.0;  // posterior; 0: c is not known at all, infinite: known
  double constant_ = 0.0;
  Vec3 tilt_ = Vec3::Zero();
  Eigen::Matrix3d tilt_covariance_ = Eigen::Matrix3d::Zero();
  Vec3 constant_per_tilt_ = Vec3::Zero();  // by how much c falls for each
};

}  // namespace palpation
