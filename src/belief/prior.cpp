#include "palpation/belief/prior.h"

#include <utility>

#include "palpation/base/error.h"

namespace palpation {

Prior::Prior(Surface surface, Metric metric, const Kernel& kernel, Constant constant)
    : surface_(std::move(surface)), metric_(metric), kernel_(kernel), constant_(constant) {
  check(kernel);
  require(kernel.family != KernelFamily::Periodic || metric == Metric::Chart, "Prior", "the periodic kernel", "needs the chart metric");
  require(constant.sd >= 0.0, "Prior", "constant.sd = " + text_of(constant.sd), "must not be negative or NaN");
  if (metric == Metric::Chart) surface_.chart();
}

Prior Prior::with(const Kernel& kernel) const { return Prior(surface_, metric_, kernel, constant_); }

Vec3 Prior::coordinates(int vertex) const {
  if (metric_ == Metric::Ambient) return surface_.vertex(vertex);
  const Points2& uv = surface_.chart().uv;
  return {uv(vertex, 0), uv(vertex, 1), 0.0};
}

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

}  // namespace palpation
