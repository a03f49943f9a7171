/// How probable readings are with waves of healthy tissue among them.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "base/cholesky.h"
#include "certainty/edge_data.h"
#include "certainty/slow_waves.h"

namespace palpation {

/// Normal readings, less what is expected of them, and their covariance without waves and noise.
struct Rows {
  EdgeData data;
  Eigen::VectorXd off;
  Eigen::MatrixXd covariance;
};

/// With waves of some height.
struct WavesFound {
  double log_density = -std::numeric_limits<double>::infinity();
  double height = 0.0;             ///< in readings
  Eigen::VectorXd coefficients{};  ///< their mean, of waves of height one
};

/// For waves of any length: with C the covariance of the readings and their noise, and F what one
/// unit of each coefficient adds, all of (C + h^2 F F')^-1 is told by F' C^-1 F. Densities are
/// without what depends on the number of readings alone, as EdgeBelief::log_evidence is.
class WithWaves {
 public:
  /// `spread`: how the readings do, which heights and noise are multiples of.
  WithWaves(Rows rows, double spread);

  /// Without waves, by the likeliest noise.
  double level() const { return level_; }
  /// C^-1 times what readings are off by, with that noise: what it tells of all that is among them.
  Eigen::VectorXd pull() const;
  /// With waves of these terms (SlowWaves::terms), of each height by the likeliest noise, which is
  /// looked for from the likeliest without waves on.
  std::vector<WavesFound> of(const Eigen::MatrixXd& terms) const;

 private:
  struct ByNoise {
    TiledLlt factor;
    Eigen::VectorXd off;
    double log_density = -std::numeric_limits<double>::infinity();
  };
  /// Nothing where no noise makes the covariance positive definite.
  const std::optional<ByNoise>& by_noise(std::size_t noise) const;

  Rows rows_;
  double spread_;
  mutable std::vector<std::optional<std::optional<ByNoise>>> by_noise_;  // where it was asked for
  std::size_t likeliest_ = 0;
  double level_ = -std::numeric_limits<double>::infinity();
};

}  // namespace palpation
