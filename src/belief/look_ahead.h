/// What would be left of the variance at the vertices if some of them were touched, whatever is
/// felt there: worked out eight vertices at a time, and only where it is asked for.
///
///     e_k(x) = (c(x, x_k) - sum_{j<k} e_j(x) e_j(x_k)) / sqrt(variance_k + noise_k),   variance =
///     variance_0 - sum_k e_k^2,
///
/// c the posterior covariance: one more row of a Cholesky factor for each supposed touch.
#pragma once

#include <span>
#include <vector>

#include "palpation/belief/belief.h"

namespace palpation {

class VertexTiles;

class LookAhead {
 public:
  /// Keeps a reference: the belief must outlive it. `variance`: at the vertices, before any touch.
  LookAhead(const Belief& belief, const Field& variance);
  ~LookAhead();
  LookAhead(const LookAhead&) = delete;
  LookAhead& operator=(const LookAhead&) = delete;

  int tile_count() const;
  /// Up to eight vertices that lie together.
  std::span<const int> vertices(int tile) const;
  int tile_of(int vertex) const;
  /// Their variances, one after another, after all touches that the tile knows of ...
  const double* variances(int tile) const;
  /// ... and whether that is all of them; `bring_up_to_date` makes it so. A variance never grows by
  /// it.
  bool is_current(int tile) const;
  void bring_up_to_date(int tile);

  /// Supposes a touch whose reading has this noise variance.
  void touch(int vertex, double noise_variance);

 private:
  int touch_count() const;
  void add_covariances(int tile, int first, int count, double* rows) const;

  struct Touch;

  const BeliefState& state_;
  const VertexTiles& tiles_;
  double signal_variance_;
  std::vector<Touch> touches_;
  std::vector<double> columns_;         // of V at the touches, one after another
  std::vector<double> variance_;        // a tile after another
  std::vector<int> known_;              // touches that each tile knows of,
  std::vector<std::vector<double>> e_;  // and their e, a row of eight each
};

}  // namespace palpation
