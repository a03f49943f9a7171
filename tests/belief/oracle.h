/// The posterior to eighty digits: equations (1) and (2) of Garg et al. 2016 by Cholesky's factor,
/// nothing clever. What the library computes in double precision is held against it, from the same
/// coordinates, readings and noise taken as exact numbers.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <vector>

#include "palpation/belief/belief.h"

namespace palpation {

using Big = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<80>,
                                          boost::multiprecision::et_off>;
using BigVector = std::vector<Big>;

inline Big big_correlation(const Kernel& kernel, const Vec3& a, const Vec3& b) {
  Big r2 = 0;
  const Big pi = boost::math::constants::pi<Big>();
  for (int axis = 0; axis < 3; ++axis) {
    Big d = Big(a[axis]) - Big(b[axis]);
    if (kernel.family == KernelFamily::Periodic)
      d = Big(kernel.period_m) / pi * sin(pi * d / Big(kernel.period_m));
    d /= Big(kernel.length_m);
    r2 += d * d;
  }
  const Big r = sqrt(r2);
  switch (kernel.family) {
    case KernelFamily::SquaredExponential:
    case KernelFamily::Periodic:
      return exp(-r2 / 2);
    case KernelFamily::Matern12:
      return exp(-r);
    case KernelFamily::Matern32: {
      const Big s = sqrt(Big(3)) * r;
      return (1 + s) * exp(-s);
    }
    case KernelFamily::Matern52: {
      const Big s = sqrt(Big(5)) * r;
      return (1 + s + s * s / 3) * exp(-s);
    }
  }
  return 0;
}

/// Of one row for each reading: repeated places stay apart.
class BigPosterior {
 public:
  /// `noise_variance`: of readings that bring none of their own.
  BigPosterior(const Prior& prior, const std::vector<Palpation>& palpations, double noise_variance)
      : kernel_(prior.kernel()), signal_variance_(Big(kernel_.signal_sd) * Big(kernel_.signal_sd)) {
    const std::size_t n = palpations.size();
    for (const Palpation& palpation : palpations)
      places_.push_back(prior.coordinates(palpation.where));
    BigVector readings, ones(n, Big(1));
    for (std::size_t i = 0; i < n; ++i) {
      factor_.push_back(BigVector(i + 1));
      for (std::size_t j = 0; j <= i; ++j)
        factor_[i][j] = signal_variance_ * big_correlation(kernel_, places_[i], places_[j]);
      const double own = palpations[i].noise_variance;
      factor_[i][i] += Big(std::isnan(own) ? noise_variance : own);
      readings.push_back(Big(palpations[i].reading));
    }
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        for (std::size_t k = 0; k < j; ++k) factor_[i][j] -= factor_[i][k] * factor_[j][k];
        factor_[i][j] = i == j ? sqrt(factor_[i][i]) : factor_[i][j] / factor_[j][j];
      }
    }
    ones_ = solve(ones);
    whitened_ = solve(readings);
    if (prior.constant().sd == 0.0 || n == 0) return;
    precision_ = dot(ones_, ones_);
    if (std::isfinite(prior.constant().sd))
      precision_ += 1 / (Big(prior.constant().sd) * Big(prior.constant().sd));
    constant_ = dot(ones_, whitened_) / precision_;
  }

  struct At {
    Big mean, variance;
  };
  At at(const Vec3& place) const {
    const BigVector v = seen_from(place);
    const Big rest = 1 - dot(v, ones_);
    At result{constant_ + dot(v, whitened_) - constant_ * dot(v, ones_),
              signal_variance_ - dot(v, v)};
    if (precision_ > 0) result.variance += rest * rest / precision_;
    return result;
  }

  Big covariance(const Vec3& a, const Vec3& b) const {
    const BigVector v = seen_from(a), w = seen_from(b);
    Big result = signal_variance_ * big_correlation(kernel_, a, b) - dot(v, w);
    if (precision_ > 0) result += (1 - dot(v, ones_)) * (1 - dot(w, ones_)) / precision_;
    return result;
  }

  /// Log density of the readings, restricted where the constant is not known (its prior flat).
  Big log_likelihood() const {
    const std::size_t n = places_.size();
    Big square = 0, result = -Big(n - (precision_ > 0 ? 1 : 0)) / 2 *
                             log(2 * boost::math::constants::pi<Big>());
    for (std::size_t i = 0; i < n; ++i) {
      const Big rest = whitened_[i] - constant_ * ones_[i];
      square += rest * rest;
      result -= log(factor_[i][i]);
    }
    if (precision_ > 0) result -= log(precision_) / 2;
    return result - square / 2;
  }

 private:
  static Big dot(const BigVector& a, const BigVector& b) {
    Big sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  }

  BigVector solve(BigVector right) const {
    for (std::size_t i = 0; i < right.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) right[i] -= factor_[i][j] * right[j];
      right[i] /= factor_[i][i];
    }
    return right;
  }

  BigVector seen_from(const Vec3& place) const {
    BigVector k;
    for (const Vec3& other : places_)
      k.push_back(signal_variance_ * big_correlation(kernel_, place, other));
    return solve(k);
  }

  Kernel kernel_;
  Big signal_variance_;
  std::vector<Vec3> places_;
  std::vector<BigVector> factor_;
  BigVector ones_, whitened_;
  Big constant_ = 0, precision_ = 0;
};

/// |ours - exact| over |exact|.
inline double relative_error(double ours, const Big& exact) {
  return static_cast<double>(abs((Big(ours) - exact) / exact));
}
inline double absolute_error(double ours, const Big& exact) {
  return static_cast<double>(abs(Big(ours) - exact));
}

}  // namespace palpation
