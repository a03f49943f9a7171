/// The field before any touch: a Gaussian process over a surface.
///
///     f(x) = c + b.(x - x0) + g(x),   g ~ GP(0, signal_sd^2 correlation(x - x')),
///
/// x a place's coordinates in the metric: of the chart (u, v, 0) or of space. The constant c is 0, normal, or wholly unknown. The slope b,
/// normal around 0, is what a tilted tissue or a drifting sensor adds; there is none unless it is asked for.
#pragma once

#include <limits>
#include <span>

#include "palpation/belief/kernel.h"
#include "palpation/geometry/surface.h"

namespace palpation {

enum class Metric {
  Chart,    ///< distance in the chart: the paper's model; planar and developable tissue
  Ambient,  ///< straight distance in space: any surface, no chart needed
};

/// The constant c of the field.
struct Constant {
  double sd = std::numeric_limits<double>::infinity();  ///< prior standard deviation: 0 for a field of zero mean, infinite for "unknown"
};

/// The slope b of the field along each coordinate of the metric.
struct Slope {
  Vec3 sd = Vec3::Zero();      ///< prior standard deviation, reading units per metre; 0: no slope along this coordinate
  Vec3 origin = Vec3::Zero();  ///< x0, where the slope adds nothing
};

class Prior {
 public:
  /// Throws InvalidInput if the kernel is not valid (kernel.h), if it is periodic in the ambient metric, if the constant's sd is negative
  /// or NaN, if the slope's is that or infinite or its origin not finite, and as Surface::chart in the chart metric.
  Prior(Surface surface, Metric metric, const Kernel& kernel, Constant constant = {}, const Slope& slope = {});

  const Surface& surface() const { return surface_; }
  Metric metric() const { return metric_; }
  const Kernel& kernel() const { return kernel_; }
  Constant constant() const { return constant_; }
  const Slope& slope() const { return slope_; }
  bool has_slope() const { return !slope_.sd.isZero(0.0); }

  /// The same prior with other hyperparameters; shares the rest.
  Prior with(const Kernel& kernel) const;

  /// Coordinates of a vertex, and of any place, in the metric.
  Vec3 coordinates(int vertex) const;
  Vec3 coordinates(const SurfacePoint& point) const;

  /// What a slope of one standard deviation along each coordinate adds at x.
  Vec3 tilt(const Vec3& x) const { return slope_.sd.cwiseProduct(x - slope_.origin); }

  /// Covariance of g, n x m, reading units squared.
  Eigen::MatrixXd covariance(std::span<const SurfacePoint> rows, std::span<const SurfacePoint> columns) const;

 private:
  Surface surface_;
  Metric metric_;
  Kernel kernel_;
  Constant constant_;
  Slope slope_;
};

/// A slope that may change the field by `sd` from the middle of the surface to its sides, along every coordinate in which it extends.
Slope slope_across(const Surface& surface, Metric metric, double sd);

}  // namespace palpation
