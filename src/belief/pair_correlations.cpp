#include "belief/pair_correlations.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/targets.h"
#include "base/tile.h"
#include "belief/intrinsic.h"
#include "belief/isotropic.h"

namespace palpation {
namespace {

double inverse_root(double square) {
  return 1.0 / std::sqrt(std::max(square, std::numeric_limits<double>::min()));
}

/// correlation() and correlation_slope() of a Matern kernel, where `slope` was s and `value` e^-s.
PALPATION_TARGETS void finish_matern(KernelFamily family, Eigen::Index count,
                                     double* __restrict value, double* __restrict slope) {
  for (Eigen::Index i = 0; i < count; ++i) {
    const double s = slope[i], decay = value[i];
    if (family == KernelFamily::Matern12) {
      slope[i] = s * decay;
    } else if (family == KernelFamily::Matern32) {
      value[i] = (1.0 + s) * decay;
      slope[i] = s * s * decay;
    } else {
      value[i] = (1.0 + s + s * s / 3.0) * decay;
      slope[i] = s * s * (1.0 + s) / 3.0 * decay;
    }
  }
}

}  // namespace

PairCorrelations::PairCorrelations(const Prior& prior, std::span<const Site> sites)
    : prior_(prior),
      count_(static_cast<Eigen::Index>(sites.size())),
      stride_((count_ + kLanes - 1) / kLanes * kLanes) {
  squares_.setZero(stride_ * count_);
  value_ = slope_ = squares_;
  if (prior.metric() == Metric::Intrinsic) {
    modes_.resize(count_, prior.spectrum().rank());
    for (Eigen::Index i = 0; i < count_; ++i) modes_.row(i) = sites[i].place.modes;
    return;
  }
  coordinates_.resize(3, count_);
  for (Eigen::Index i = 0; i < count_; ++i) coordinates_.col(i) = sites[i].place.coordinates;
  for (Eigen::Index j = 0; j < count_; ++j) {
    squares_.segment(j * stride_, count_) =
        (coordinates_.colwise() - coordinates_.col(j)).colwise().squaredNorm();
  }
}

void PairCorrelations::set_length(double length_m) {
  Kernel kernel = prior_.kernel();
  kernel.length_m = length_m;
  if (prior_.metric() == Metric::Intrinsic) {
    of_modes(kernel);
  } else if (kernel.family == KernelFamily::Periodic || !has_usual_length(kernel)) {
    of_differences(kernel);
  } else {
    of_distances(kernel);
  }
}

/// As correlation() and correlation_slope() have them, a column from its diagonal's tile on at a
/// time.
void PairCorrelations::of_distances(const Kernel& kernel) {
  const double inverse_square = 1.0 / (kernel.length_m * kernel.length_m);
  for (Eigen::Index j = 0; j < count_; ++j) {
    const Eigen::Index first = j / kLanes * kLanes, count = stride_ - first;
    const auto square = squares_.segment(j * stride_ + first, count);
    auto value = value_.segment(j * stride_ + first, count),
         slope = slope_.segment(j * stride_ + first, count);
    if (kernel.family == KernelFamily::SquaredExponential) {
      value = -0.5 * inverse_square * square;
      exponentials(value.data(), count);
      slope = inverse_square * square * value;
    } else {
      slope = (matern_scale(kernel.family) * inverse_square * square).sqrt().min(kFar);
      value = -slope;
      exponentials(value.data(), count);
      finish_matern(kernel.family, count, value.data(), slope.data());
    }
  }
}

void PairCorrelations::of_differences(const Kernel& kernel) {
  for (Eigen::Index j = 0; j < count_; ++j) {
    for (Eigen::Index i = j; i < count_; ++i) {
      const Vec3 difference = coordinates_.col(i) - coordinates_.col(j);
      value_[j * stride_ + i] = correlation(kernel, difference);
      slope_[j * stride_ + i] = correlation_slope(kernel, difference);
    }
  }
}

/// With K = sum phi phi' s and c = K(x,y) / sqrt(K(x,x) K(y,y)): c' = K'(x,y) / sqrt(..) - c
/// (K'(x,x) / K(x,x) + K'(y,y) / K(y,y)) / 2.
void PairCorrelations::of_modes(const Kernel& kernel) {
  const Eigen::VectorXd& eigenvalues = prior_.spectrum().values();
  const Eigen::VectorXd weights = spectral_weights(kernel, eigenvalues);
  Eigen::MatrixXd unit = modes_;
  for (Eigen::Index i = 0; i < unit.rows(); ++i)
    unit.row(i) *= inverse_root((unit.row(i).cwiseAbs2() * weights).value());
  using Square = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
  Square value(value_.data(), count_, count_, Eigen::OuterStride<>(stride_)),
      slope(slope_.data(), count_, count_, Eigen::OuterStride<>(stride_));
  value.noalias() = unit * weights.asDiagonal() * unit.transpose();
  value.diagonal().setOnes();
  slope.noalias() = unit * spectral_slopes(kernel, eigenvalues).asDiagonal() * unit.transpose();
  const Eigen::VectorXd own = slope.diagonal();
  slope.array() -= 0.5 * value.array() *
                   (own.replicate(1, count_) + own.transpose().replicate(count_, 1)).array();
}

}  // namespace palpation
