/// The prior in few numbers: features f of a place, one for each of M pivots, with which the
/// correlation of two places is f.f' but for a residual that is nowhere greater than a tolerance.
///
///     f(x) = L^-1 k(pivots, x),  L L' = K(pivots, pivots),  residual(x, x') = k(x, x') -
///     f(x).f(x'),
///
/// the pivots chosen greedily, each where the residual is greatest among candidates (pivoted
/// Cholesky: Harbrecht, Peters and Schneider 2012). The residual is a covariance itself, that of
/// the field once the pivots are known without noise: |residual(x, x')| is at most the greater of
/// the residuals at x and at x'.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/tile.h"
#include "belief/aligned.h"
#include "belief/correlations.h"
#include "belief/vertex_tiles.h"

namespace palpation {

class Features {
 public:
  /// Features whose residual is at most `tolerance` at every vertex and every one of `sites`, or
  /// nothing if `most` are not enough. Those that are known already, where given and enough.
  static std::shared_ptr<const Features> of(const Prior& prior, std::span<const Site> sites,
                                            double tolerance, int most,
                                            const std::shared_ptr<const Features>& known = nullptr);

  int rank() const { return static_cast<int>(pivots_.size()); }
  /// The greatest residual at a vertex; no less than what rounding can hide.
  double residual() const { return residual_; }
  /// rank() rows of kLanes: the features of eight vertices.
  const double* tile(int number) const {
    return rows_.get() + static_cast<long>(number) * rank() * kLanes;
  }
  TileRows rows() const { return {rows_.get(), static_cast<long>(rank()) * kLanes, rank()}; }
  Eigen::VectorXd at_vertex(int vertex) const;
  /// One column for each site, rank() rows.
  Eigen::MatrixXd at(const Prior& prior, std::span<const Site> sites) const;
  Eigen::VectorXd at(const Prior& prior, const Place& place) const;

 private:
  bool choose_pivots(const Prior& prior, std::span<const Site> candidates, double tolerance,
                     int most);
  void visit_vertices(const Prior& prior, int step);
  /// L^-1 of every column.
  void solve(Eigen::MatrixXd& columns) const;

  std::vector<Site> pivots_;
  std::optional<PackedFactor> factor_;  // L
  const VertexTiles* tiles_ = nullptr;  // the prior's, shared by all that look at the features
  AlignedDoubles rows_;
  Field residuals_;
  double residual_ = 0.0;
};

}  // namespace palpation
