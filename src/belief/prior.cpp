#include "palpation/belief/prior.h"

#include <cmath>
#include <limits>
#include <utility>

#include "palpation/base/error.h"

namespace palpation {
namespace {

Vec3 coordinates_of(const Surface& surface, Metric metric, int vertex) {
  if (metric == Metric::Ambient) return surface.vertex(vertex);
  const Points2& uv = surface.chart().uv;
  return {uv(vertex, 0), uv(vertex, 1), 0.0};
}

/// An extent below this part of the greatest is that of rounding.
constexpr double kFlat = 1e-9;

}  // namespace

Prior::Prior(Surface surface, Metric metric, const Kernel& kernel, Constant constant, const Slope& slope)
    : surface_(std::move(surface)), metric_(metric), kernel_(kernel), constant_(constant), slope_(slope) {
  check(kernel);
  require(kernel.family != KernelFamily::Periodic || metric == Metric::Chart, "Prior", "the periodic kernel", "needs the chart metric");
  require(constant.sd >= 0.0, "Prior", "constant.sd = " + text_of(constant.sd), "must not be negative or NaN");
  for (const double sd : slope.sd) {
    require(std::isfinite(sd) && sd >= 0.0, "Prior", "slope.sd = " + text_of(sd), "must be finite and not negative");
  }
  require(slope.origin.allFinite(), "Prior", "slope.origin", "must be finite");
  if (metric == Metric::Chart) surface_.chart();
}

Prior Prior::with(const Kernel& kernel) const { return Prior(surface_, metric_, kernel, constant_, slope_); }

Vec3 Prior::coordinates(int vertex) const { return coordinates_of(surface_, metric_, vertex); }

Vec3 Prior::coordinates(const SurfacePoint& point) const {
  const Eigen::Vector3i corners = surface_.triangle(point.face);
  for (int corner = 0; corner < 3; ++corner) {
    if (point.barycentric[corner] == 1.0) return coordinates(corners[corner]);
  }
  Vec3 sum = Vec3::Zero();
  for (int corner = 0; corner < 3; ++corner) sum += point.barycentric[corner] * coordinates(corners[corner]);
  return sum;
}

Eigen::MatrixXd Prior::covariance(std::span<const SurfacePoint> rows, std::span<const SurfacePoint> columns) const {
  Eigen::MatrixXd result(rows.size(), columns.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Vec3 x = coordinates(rows[i]);
    for (std::size_t j = 0; j < columns.size(); ++j) {
      result(i, j) = kernel_.signal_sd * kernel_.signal_sd * correlation(kernel_, x - coordinates(columns[j]));
    }
  }
  return result;
}

Slope slope_across(const Surface& surface, Metric metric, double sd) {
  Vec3 least = Vec3::Constant(std::numeric_limits<double>::infinity()), greatest = -least;
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    const Vec3 x = coordinates_of(surface, metric, vertex);
    least = least.cwiseMin(x);
    greatest = greatest.cwiseMax(x);
  }
  const Vec3 half_width = 0.5 * (greatest - least);
  Slope slope{.origin = least + half_width};
  for (int axis = 0; axis < 3; ++axis) {
    if (half_width[axis] > kFlat * half_width.maxCoeff()) slope.sd[axis] = sd / half_width[axis];
  }
  return slope;
}

}  // namespace palpation
