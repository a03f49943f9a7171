/// The field before any touch: a Gaussian process over a surface.
///
///     f(x) = c + g(x),   g ~ GP(0, signal_sd^2 correlation(x - x')),
///
/// x a place's coordinates in the metric: of the chart (u, v, 0) or of space. The constant c is 0, normal, or wholly unknown.
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

class Prior {
 public:
  /// Throws InvalidInput if the kernel is not valid (kernel.h), if it is periodic in the ambient metric, if the constant's sd is negative
  /// or NaN, and as Surface::chart in the chart metric.
  Prior(Surface surface, Metric metric, const Kernel& kernel, Constant constant = {});

  const Surface& surface() const { return surface_; }
  Metric metric() const { return metric_; }
  const Kernel& kernel() const { return kernel_; }
  Constant constant() const { return constant_; }

  /// The same prior with other hyperparameters; shares the rest.
  Prior with(const Kernel& kernel) const;

  /// Coordinates of a vertex, and of any place, in the metric.
  Vec3 coordinates(int vertex) const;
  Vec3 coordinates(const SurfacePoint& point) const;

  /// Covariance of g, n x m, reading units squared.
  Eigen::MatrixXd covariance(std::span<const SurfacePoint> rows, std::span<const SurfacePoint> columns) const;

 private:
  Surface surface_;
  Metric metric_;
  Kernel kernel_;
  Constant constant_;
};

}  // namespace palpation
