/// The field before any touch: a Gaussian process over a surface.
///
///     f(x) = c + b.(x - x0) + g(x),   g ~ GP(0, signal_sd^2 correlation(x - x')),
///
/// x a place's coordinates in the metric: of the chart (u, v, 0) or of space. The constant c is 0,
/// normal, or wholly unknown. The slope b, normal around 0, is what a tilted tissue or a drifting
/// sensor adds; there is none unless it is asked for.
///
/// In the intrinsic metric coordinates are those of space, which only the slope uses; the
/// correlation is that of the surface's own waves,
///
///     f_j(x) = phi_j(x) sqrt(s(lambda_j)),   correlation(x, x') = f(x).f(x') / (|f(x)| |f(x')|),
///
/// over the modes of its spectrum (spectrum.h): for the squared exponential the heat kernel, s =
/// exp(-length^2 lambda / 2), for a Matern of smoothness nu s = (1 + length^2 lambda / (2 nu))^-(nu
/// + 1) (Borovitskiy et al. 2020; Lindgren et al. 2011). On a plane that is the same function of
/// distance as in the other metrics, so lengths mean the same in all. Inside faces waves are
/// linear, and |f| is taken there. Borders are not felt: the surface goes on flat for 1.75 lengths
/// before its spectrum is made. Of the variance the modes left out hold less than 1e-4 with a
/// squared exponential, 1 % with Matern 5/2, 4 % with Matern 3/2.
#pragma once

#include <limits>
#include <memory>
#include <span>

#include "palpation/belief/kernel.h"
#include "palpation/geometry/surface.h"

namespace palpation {

class VertexTiles;

enum class Metric {
  Chart,      ///< distance in the chart: the paper's model; planar and developable tissue
  Ambient,    ///< straight distance in space: any surface, no chart needed
  Intrinsic,  ///< along the surface, by the waves of its Laplacian: organs that bend, or fold back
              ///< on themselves
};

/// Lengths that the spectrum of the intrinsic metric must serve; without any, the kernel's own. For
/// a range, modes are left out that hold 1 % of a squared exponential's variance at the least
/// length, and the margin is as wide as the greatest length.
struct LengthRange {
  double least_m = 0.0;
  double most_m = 0.0;
};

/// The lengths among which one of this median is learned in the intrinsic metric: 0.6 to 2 of it.
LengthRange lengths_to_learn(double median_m);

/// A place as a prior sees it.
struct Place {
  Vec3 coordinates = Vec3::Zero();
  Eigen::VectorXd modes{};  ///< of the surface's spectrum; empty but in the intrinsic metric
  bool operator==(const Place& other) const {
    return coordinates == other.coordinates && modes == other.modes;
  }
};

/// The constant c of the field.
struct Constant {
  double sd = std::numeric_limits<double>::infinity();  ///< prior standard deviation: 0 for a field
                                                        ///< of zero mean, infinite for "unknown"
};

/// The slope b of the field along each coordinate of the metric.
struct Slope {
  Vec3 sd = Vec3::Zero();  ///< prior standard deviation, reading units per metre; 0: no slope along
                           ///< this coordinate
  Vec3 origin = Vec3::Zero();  ///< x0, where the slope adds nothing
};

class Prior {
 public:
  /// Throws InvalidInput if the kernel is not valid (kernel.h), if it is not one of the metric's
  /// (periodic: chart only; intrinsic: squared exponential, Matern 3/2 and 5/2), if the constant's
  /// sd is negative or NaN, if the slope's is that or infinite or its origin not finite, if the
  /// kernel's length is below the range's least, if that asks for more modes than a spectrum may
  /// have, and as Surface::chart in the chart metric. `lengths` matter in the intrinsic metric
  /// alone.
  Prior(Surface surface, Metric metric, const Kernel& kernel, Constant constant = {},
        const Slope& slope = {}, LengthRange lengths = {});

  const Surface& surface() const { return surface_; }
  Metric metric() const { return metric_; }
  const Kernel& kernel() const { return kernel_; }
  Constant constant() const { return constant_; }
  const Slope& slope() const { return slope_; }
  bool has_slope() const { return !slope_.sd.isZero(0.0); }
  LengthRange lengths() const { return lengths_; }

  /// The same prior with other hyperparameters, or another constant and slope too; shares the rest.
  /// In the intrinsic metric the length must not be below the range's; one above it feels the
  /// border a little.
  Prior with(const Kernel& kernel) const { return with(kernel, constant_, slope_); }
  Prior with(const Kernel& kernel, Constant constant, const Slope& slope) const;

  /// Of the intrinsic metric alone.
  const Spectrum& spectrum() const { return *spectrum_; }

  /// Coordinates of a vertex, and of any place, in the metric.
  Vec3 coordinates(int vertex) const;
  Vec3 coordinates(const SurfacePoint& point) const;
  Place place(const SurfacePoint& point) const;

  /// What a slope of one standard deviation along each coordinate adds at x.
  Vec3 tilt(const Vec3& x) const { return slope_.sd.cwiseProduct(x - slope_.origin); }

  /// Covariance of g, n x m, reading units squared.
  Eigen::MatrixXd covariance(std::span<const SurfacePoint> rows,
                             std::span<const SurfacePoint> columns) const;

  /// The order in which beliefs store vertices: of this folder alone.
  const VertexTiles& tiles() const;

  /// Variance of g at the vertices over that on a plane, before it is normalized to 1: how even the
  /// surface and its margin leave it. All 1 but in the intrinsic metric.
  Field raw_variance() const;

 private:
  friend class TileCorrelations;
  struct Norms;      // of the features at the vertices
  struct LazyTiles;  // of the vertices in the metric
  void check_all() const;
  const Norms& norms() const;

  Surface surface_;
  Metric metric_;
  Kernel kernel_;
  Constant constant_;
  Slope slope_;
  LengthRange lengths_;
  std::shared_ptr<const Spectrum> spectrum_;
  std::shared_ptr<Norms> norms_;
  std::shared_ptr<LazyTiles> tiles_;
};

/// A slope that may change the field by `sd` from the middle of the surface to its sides, along
/// every coordinate in which it extends.
Slope slope_across(const Surface& surface, Metric metric, double sd);

}  // namespace palpation
