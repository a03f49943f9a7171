/// The correlations that a belief asks of its prior, in whichever metric: functions of a difference
/// of coordinates, or products of features.
#pragma once

#include <Eigen/Core>
#include <mutex>
#include <optional>
#include <span>

#include "base/tile.h"
#include "belief/sites.h"
#include "geometry/spectrum.h"
#include "palpation/belief/prior.h"

namespace palpation {

/// Of a prior's kernel, made at first use.
struct Prior::Norms {
  std::once_flag once;
  Eigen::VectorXd weights;  // s at the eigenvalues
  Eigen::VectorXd inverse;  // 1 / |f| at the vertices, and 0 beyond the last to fill its tile
};

/// 1 / sqrt(sum_j phi_j^2 s_j) at the vertices, in whole tiles.
Eigen::VectorXd inverse_norms(const Spectrum& spectrum, const Eigen::VectorXd& weights);

/// f / |f| of the places, one a row, in the intrinsic metric.
Eigen::MatrixXd unit_features(const Prior& prior, std::span<const SurfacePoint> points);

/// Of all sites (rows) with those from `first` on (columns).
Eigen::MatrixXd correlations(const Prior& prior, const Kernel& kernel, std::span<const Site> sites,
                             int first = 0);

/// Of a place with sites.
Eigen::VectorXd correlations_with(const Prior& prior, const Place& place,
                                  std::span<const Site> sites);

/// Of places with the vertices, a tile of eight at a time (vertex_tiles.h).
class TileCorrelations {
 public:
  /// Keeps a reference to the prior.
  TileCorrelations(const Prior& prior, std::span<const Site> sites);
  TileCorrelations(const Prior& prior, int vertex);

  /// Rows of kLanes, one for each place, of each tile from the first on. What stands in lanes
  /// beyond the last vertex means nothing.
  void operator()(int first_tile, int tile_count, double* rows) const;

 private:
  void weigh(std::span<const Eigen::VectorXd> modes);
  void of_modes(int first_tile, int tile_count, double* rows) const;
  void of_differences(const double* coordinates, double* rows) const;
  void of_distances(const double* coordinates, double* rows) const;

  const Prior& prior_;
  int count_;
  std::vector<double> coordinates_;         // three of each place, or:
  std::optional<PackedFactor> minus_rows_;  // places x modes: -phi s / |f|
};

}  // namespace palpation
