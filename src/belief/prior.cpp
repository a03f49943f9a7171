#include "palpation/belief/prior.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "belief/correlations.h"
#include "belief/intrinsic.h"
#include "belief/vertex_tiles.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

Vec3 coordinates_of(const Surface& surface, Metric metric, int vertex) {
  if (metric != Metric::Chart) return surface.vertex(vertex);
  const Points2& uv = surface.chart().uv;
  return {uv(vertex, 0), uv(vertex, 1), 0.0};
}

/// An extent below this part of the greatest is that of rounding.
constexpr double kFlat = 1e-9;

/// The modes for a kernel and its range, or why there are none.
std::shared_ptr<const Spectrum> spectrum_for(const Surface& surface, KernelFamily family,
                                             const LengthRange& lengths) {
  try {
    return surface.spectrum(range_for(family, lengths));
  } catch (const InvalidInput& error) {
    throw InvalidInput(
        "Prior: length_m = " + text_of(lengths.least_m) +
        " is too short for the intrinsic metric on this surface (" + error.what() +
        "): take a longer length, a smaller patch or a finer mesh, or the ambient metric");
  }
}

}  // namespace

/// Made at first use, shared by the priors of all hyperparameters.
struct Prior::LazyTiles {
  std::once_flag once;
  std::unique_ptr<const VertexTiles> tiles;
};

Prior::Prior(Surface surface, Metric metric, const Kernel& kernel, Constant constant,
             const Slope& slope, LengthRange lengths)
    : surface_(std::move(surface)),
      metric_(metric),
      kernel_(kernel),
      constant_(constant),
      slope_(slope),
      lengths_(lengths),
      tiles_(std::make_shared<LazyTiles>()) {
  if (lengths_.most_m == 0.0) lengths_ = {kernel.length_m, kernel.length_m};
  check_all();
  if (metric == Metric::Chart) surface_.chart();
  if (metric != Metric::Intrinsic) return;
  require(std::isfinite(lengths_.most_m) && lengths_.least_m > 0.0 &&
              lengths_.least_m <= lengths_.most_m,
          "Prior", "lengths from " + text_of(lengths_.least_m) + " to " + text_of(lengths_.most_m),
          "must be positive, finite and in order");
  spectrum_ = spectrum_for(surface_, kernel.family, lengths_);
  norms_ = std::make_shared<Norms>();
}

void Prior::check_all() const {
  check(kernel_);
  require(kernel_.family != KernelFamily::Periodic || metric_ == Metric::Chart, "Prior",
          "the periodic kernel", "needs the chart metric");
  require(constant_.sd >= 0.0, "Prior", "constant.sd = " + text_of(constant_.sd),
          "must not be negative or NaN");
  for (const double sd : slope_.sd) {
    require(std::isfinite(sd) && sd >= 0.0, "Prior", "slope.sd = " + text_of(sd),
            "must be finite and not negative");
  }
  require(slope_.origin.allFinite(), "Prior", "slope.origin", "must be finite");
  if (metric_ != Metric::Intrinsic) return;
  require(has_spectral_form(kernel_.family), "Prior", "the Matern 1/2 kernel",
          "is none of the intrinsic metric's");
  constexpr double kRounding = 1e-9;
  require(kernel_.length_m >= (1.0 - kRounding) * lengths_.least_m, "Prior",
          "length_m = " + text_of(kernel_.length_m),
          "must be at least " + text_of(lengths_.least_m) +
              ", the least of the lengths that this intrinsic prior was made for");
}

Prior Prior::with(const Kernel& kernel, Constant constant, const Slope& slope) const {
  Prior next = *this;
  next.kernel_ = kernel;
  next.constant_ = constant;
  next.slope_ = slope;
  if (metric_ != Metric::Intrinsic) next.lengths_ = {kernel.length_m, kernel.length_m};
  next.check_all();
  if (norms_ && (kernel.family != kernel_.family || kernel.length_m != kernel_.length_m))
    next.norms_ = std::make_shared<Norms>();
  return next;
}

const Prior::Norms& Prior::norms() const {
  std::call_once(norms_->once, [this] {
    norms_->weights = spectral_weights(kernel_, spectrum_->values());
    norms_->inverse = inverse_norms(*spectrum_, norms_->weights);
  });
  return *norms_;
}

const VertexTiles& Prior::tiles() const {
  std::call_once(tiles_->once,
                 [this] { tiles_->tiles = std::make_unique<const VertexTiles>(*this); });
  return *tiles_->tiles;
}

Field Prior::raw_variance() const {
  if (metric_ != Metric::Intrinsic) return Field::Ones(surface_.vertex_count());
  return norms().inverse.cwiseAbs2().cwiseInverse().head(surface_.vertex_count()) /
         plane_variance(kernel_);
}

Vec3 Prior::coordinates(int vertex) const { return coordinates_of(surface_, metric_, vertex); }

Vec3 Prior::coordinates(const SurfacePoint& point) const {
  if (const int vertex = surface_.vertex_at(point); vertex >= 0) return coordinates(vertex);
  const Eigen::Vector3i corners = surface_.triangle(point.face);
  Vec3 sum = Vec3::Zero();
  for (int corner = 0; corner < 3; ++corner)
    sum += point.barycentric[corner] * coordinates(corners[corner]);
  return sum;
}

Place Prior::place(const SurfacePoint& point) const {
  Place place{coordinates(point)};
  if (metric_ != Metric::Intrinsic) return place;
  const Eigen::Vector3i corners = surface_.triangle(point.face);
  place.modes = Eigen::VectorXd::Zero(spectrum_->rank());
  for (int corner = 0; corner < 3; ++corner) {
    if (point.barycentric[corner] != 0.0)
      place.modes += point.barycentric[corner] * spectrum_->at(corners[corner]);
  }
  return place;
}

Eigen::MatrixXd Prior::covariance(std::span<const SurfacePoint> rows,
                                  std::span<const SurfacePoint> columns) const {
  if (metric_ == Metric::Intrinsic) {
    const double variance = kernel_.signal_sd * kernel_.signal_sd;
    return variance * (unit_features(*this, rows) * unit_features(*this, columns).transpose());
  }
  std::vector<Vec3> places;
  places.reserve(rows.size());
  for (const SurfacePoint& row : rows) places.push_back(coordinates(row));
  Eigen::MatrixXd result(rows.size(), columns.size());
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const Vec3 x = coordinates(columns[j]);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      result(i, j) = kernel_.signal_sd * kernel_.signal_sd * correlation(kernel_, places[i] - x);
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
