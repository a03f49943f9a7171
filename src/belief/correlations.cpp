#include "belief/correlations.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/targets.h"
#include "belief/intrinsic.h"
#include "belief/isotropic.h"
#include "belief/vertex_tiles.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

double inverse_root(double square) {
  return 1.0 / std::sqrt(std::max(square, std::numeric_limits<double>::min()));
}

/// Rows f / |f| for rows of modes.
Eigen::MatrixXd unit_rows(Eigen::MatrixXd modes, const Eigen::VectorXd& weights) {
  modes *= weights.cwiseSqrt().asDiagonal();
  for (Eigen::Index i = 0; i < modes.rows(); ++i)
    modes.row(i) *= inverse_root(modes.row(i).squaredNorm());
  return modes;
}

Eigen::MatrixXd modes_of(const Spectrum& spectrum, std::span<const Site> sites) {
  Eigen::MatrixXd modes(sites.size(), spectrum.rank());
  for (std::size_t i = 0; i < sites.size(); ++i) modes.row(i) = sites[i].place.modes;
  return modes;
}

constexpr int kRowsAtOnce = 16;
/// rows[r] = scale |x - place r|^2, x the tile's eight places, over the first axes.
template <int Axes>
inline __attribute__((always_inline)) void squared_distances_over(const double* __restrict x,
                                                                  const double* __restrict places,
                                                                  int count, double scale,
                                                                  double* __restrict rows) {
  for (int row = 0; row < count; ++row) {
    for (int lane = 0; lane < kLanes; ++lane) {
      double sum = 0.0;
      for (int axis = 0; axis < Axes; ++axis) {
        const double difference = x[axis * kLanes + lane] - places[row * 3 + axis];
        sum += difference * difference;
      }
      rows[row * kLanes + lane] = scale * sum;
    }
  }
}

PALPATION_TARGETS void squared_distances_in_plane(const double* x, const double* places, int count,
                                                  double scale, double* rows) {
  squared_distances_over<2>(x, places, count, scale, rows);
}

PALPATION_TARGETS void squared_distances(const double* x, const double* places, int count,
                                         double scale, double* rows) {
  squared_distances_over<3>(x, places, count, scale, rows);
}

/// values = s, opposites = -s for values = s^2.
PALPATION_TARGETS void roots_and_opposites(double* __restrict values, double* __restrict opposites,
                                           int count) {
  for (int i = 0; i < count; ++i) {
    const double root = std::sqrt(values[i]);
    values[i] = root < kFar ? root : kFar;
    opposites[i] = -values[i];
  }
}

/// values = the Matern family's polynomial of s = values, times its decay e^-s.
void times_polynomial(KernelFamily family, const double* decay, int count, double* values) {
  for (int i = 0; i < count; ++i) {
    const double s = values[i];
    const double polynomial = family == KernelFamily::Matern12   ? 1.0
                              : family == KernelFamily::Matern32 ? 1.0 + s
                                                                 : 1.0 + s + s * s / 3.0;
    values[i] = polynomial * decay[i];
  }
}

}  // namespace

Eigen::VectorXd inverse_norms(const Spectrum& spectrum, const Eigen::VectorXd& weights) {
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(spectrum.tile_count() * kLanes);
  for_ranges(spectrum.tile_count(), 64, [&](int first, int last) {
    for (int number = first; number < last; ++number) {
      const double* tile = spectrum.tile(number);
      double sums[kLanes] = {};
      for (int mode = 0; mode < spectrum.rank(); ++mode) {
        for (int lane = 0; lane < kLanes; ++lane)
          sums[lane] += weights[mode] * tile[mode * kLanes + lane] * tile[mode * kLanes + lane];
      }
      for (int lane = 0; lane < kLanes && number * kLanes + lane < spectrum.vertex_count();
           ++lane) {
        inverse[number * kLanes + lane] = inverse_root(sums[lane]);
      }
    }
  });
  return inverse;
}

Eigen::MatrixXd unit_features(const Prior& prior, std::span<const SurfacePoint> points) {
  const Spectrum& spectrum = prior.spectrum();
  Eigen::MatrixXd modes(points.size(), spectrum.rank());
  for (std::size_t i = 0; i < points.size(); ++i) modes.row(i) = prior.place(points[i]).modes;
  return unit_rows(std::move(modes), spectral_weights(prior.kernel(), spectrum.values()));
}

Eigen::MatrixXd correlations(const Prior& prior, const Kernel& kernel, std::span<const Site> sites,
                             int first) {
  const auto n = static_cast<Eigen::Index>(sites.size()), columns = n - first;
  if (prior.metric() == Metric::Intrinsic) {
    const Eigen::MatrixXd features = unit_rows(modes_of(prior.spectrum(), sites),
                                               spectral_weights(kernel, prior.spectrum().values()));
    Eigen::MatrixXd result = features * features.bottomRows(columns).transpose();
    for (Eigen::Index j = 0; j < columns; ++j) result(first + j, j) = 1.0;
    return result;
  }
  Eigen::MatrixXd result(n, columns);
  for (Eigen::Index j = 0; j < columns; ++j) {
    for (Eigen::Index i = 0; i <= first + j; ++i) {
      result(i, j) =
          correlation(kernel, sites[i].place.coordinates - sites[first + j].place.coordinates);
      if (i >= first) result(first + j, i - first) = result(i, j);
    }
  }
  return result;
}

Eigen::VectorXd correlations_with(const Prior& prior, const Place& place,
                                  std::span<const Site> sites) {
  Eigen::VectorXd k(sites.size());
  if (prior.metric() == Metric::Intrinsic) {
    const Eigen::VectorXd weights = spectral_weights(prior.kernel(), prior.spectrum().values());
    const Eigen::VectorXd weighted = place.modes.cwiseProduct(weights);
    const double scale = inverse_root(place.modes.dot(weighted));
    for (std::size_t site = 0; site < sites.size(); ++site) {
      const Eigen::VectorXd& modes = sites[site].place.modes;
      k[site] = scale * modes.dot(weighted) *
                inverse_root((modes.cwiseAbs2().cwiseProduct(weights)).sum());
    }
    return k;
  }
  for (std::size_t site = 0; site < sites.size(); ++site) {
    k[site] = correlation(prior.kernel(), place.coordinates - sites[site].place.coordinates);
  }
  return k;
}

TileCorrelations::TileCorrelations(const Prior& prior, std::span<const Site> sites)
    : prior_(prior), count_(static_cast<int>(sites.size())) {
  if (prior.metric() != Metric::Intrinsic) {
    for (const Site& site : sites)
      coordinates_.insert(coordinates_.end(), site.place.coordinates.begin(),
                          site.place.coordinates.end());
    return;
  }
  std::vector<Eigen::VectorXd> modes;
  for (const Site& site : sites) modes.push_back(site.place.modes);
  weigh(modes);
}

TileCorrelations::TileCorrelations(const Prior& prior, int vertex) : prior_(prior), count_(1) {
  if (prior.metric() != Metric::Intrinsic) {
    const Vec3 x = prior.coordinates(vertex);
    coordinates_.assign(x.begin(), x.end());
    return;
  }
  const Eigen::VectorXd modes = prior.spectrum().at(vertex);
  weigh(std::span(&modes, 1));
}

void TileCorrelations::weigh(std::span<const Eigen::VectorXd> modes) {
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> minus_rows(
      count_, prior_.spectrum().rank());
  for (int row = 0; row < count_; ++row) {
    const Eigen::VectorXd weighted = modes[row].cwiseProduct(prior_.norms().weights);
    minus_rows.row(row) = -inverse_root(modes[row].dot(weighted)) * weighted;
  }
  minus_rows_.emplace(minus_rows.data(), minus_rows.cols(), count_, minus_rows.cols());
}

/// As correlation() has them, several rows at a time.
void TileCorrelations::of_distances(const double* coordinates, double* rows) const {
  const KernelFamily family = prior_.kernel().family;
  const double inverse_square = 1.0 / (prior_.kernel().length_m * prior_.kernel().length_m);
  const auto distances =
      prior_.metric() == Metric::Chart ? squared_distances_in_plane : squared_distances;
  if (family == KernelFamily::SquaredExponential) {
    distances(coordinates, coordinates_.data(), count_, -0.5 * inverse_square, rows);
    exponentials(rows, static_cast<long>(count_) * kLanes);
    return;
  }
  alignas(64) double decay[kRowsAtOnce * kLanes];
  for (int first = 0; first < count_; first += kRowsAtOnce) {
    const int count = std::min(kRowsAtOnce, count_ - first);
    double* target = rows + static_cast<long>(first) * kLanes;
    distances(coordinates, coordinates_.data() + static_cast<long>(first) * 3, count,
              matern_scale(family) * inverse_square, target);
    roots_and_opposites(target, decay, count * kLanes);
    exponentials(decay, count * kLanes);
    times_polynomial(family, decay, count * kLanes, target);
  }
}

void TileCorrelations::of_modes(int first_tile, int tile_count, double* rows) const {
  const int rank = prior_.spectrum().rank();
  const long per_tile = static_cast<long>(count_) * kLanes;
  std::fill_n(rows, tile_count * per_tile, 0.0);
  subtract_product(*minus_rows_,
                   {prior_.spectrum().tile(0), static_cast<long>(rank) * kLanes, rank}, first_tile,
                   tile_count, rows, per_tile);
  for (int tile = 0; tile < tile_count; ++tile) {
    const double* scale =
        prior_.norms().inverse.data() + static_cast<long>(first_tile + tile) * kLanes;
    for (long at = tile * per_tile; at < (tile + 1) * per_tile; ++at)
      rows[at] *= scale[at % kLanes];
  }
}

void TileCorrelations::of_differences(const double* coordinates, double* rows) const {
  for (int row = 0; row < count_; ++row) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const Vec3 x(coordinates[lane], coordinates[kLanes + lane], coordinates[2 * kLanes + lane]);
      rows[row * kLanes + lane] =
          correlation(prior_.kernel(), x - Eigen::Map<const Vec3>(coordinates_.data() + row * 3));
    }
  }
}

void TileCorrelations::operator()(int first_tile, int tile_count, double* rows) const {
  if (prior_.metric() == Metric::Intrinsic) return of_modes(first_tile, tile_count, rows);
  const bool is_usual =
      prior_.kernel().family != KernelFamily::Periodic && has_usual_length(prior_.kernel());
  for (int tile = 0; tile < tile_count; ++tile) {
    const double* coordinates = prior_.tiles().coordinates(first_tile + tile);
    double* target = rows + static_cast<long>(tile) * count_ * kLanes;
    is_usual ? of_distances(coordinates, target) : of_differences(coordinates, target);
  }
}

}  // namespace palpation
