/// How far readings are off an outline's profile, and how probable that is.
///
/// They are off by a background (outline_background.h), whose coefficients are integrated out, and
/// by noise, which is normal but for readings that tell nothing: one in a hundred beforehand, how
/// many, is learned. How much more those on a tumour scatter is, too (outline_scatter.h). Where the
/// sensor's range ended, how far a reading is off is drawn, too (bounded_readings.h).
/// With V the variances of those that tell, times a scale, and F S F' the background's covariance,
///
///     log p(off) = -1/2 off' V^-1 off + 1/2 |pull|^2 + ...,  pull = L^-1 S^(1/2) F' V^-1 off,
///     L L' = 1 + S^(1/2) F' V^-1 F S^(1/2),
///
/// so that to weigh a few other residuals costs as many columns of L^-1 S^(1/2) F' V^-1, and an
/// outline does not wait for its background to follow it.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <utility>
#include <vector>

#include "certainty/bounded_readings.h"
#include "certainty/outline_readings.h"
#include "certainty/outline_scatter.h"
#include "palpation/base/random.h"

namespace palpation {

/// Of what the noise's standard deviations are multiplied by, in logarithms; and how probable a
/// reading that tells nothing is, wherever it may lie. Readings that are equal to the last digit
/// would be the more probable the less noise there is, and all others told as nothing: so there is
/// a least.
struct ResidualPrior {
  double log_noise = 0.0;
  double noise_log_sd = 1.0;
  double wild_density = 1e-3;
  double least_log_noise = -std::numeric_limits<double>::infinity();
};

/// Residuals that are thought of instead, and what they change.
struct ResidualChange {
  std::vector<std::pair<std::size_t, double>> considered;
  Eigen::VectorXd pull;
  double local = 0.0;  ///< of the log density, but for the pull's part
};

class OutlineResiduals {
 public:
  /// All tell at first. `off`: what each told, less the profile. The readings must outlive it.
  OutlineResiduals(const OutlineReadings& readings, std::vector<double> off,
                   const ResidualPrior& prior, double log_noise);

  /// What if this one was so far off the profile: for `change`, until it is kept or forgotten.
  void consider(std::size_t reading, double off);
  /// Of the log density, by all that is considered.
  double change() const;
  /// No reading contradicts what is considered: else `change` is minus infinity.
  bool is_possible() const { return change_.local > -std::numeric_limits<double>::infinity(); }
  void keep();
  void forget();

  /// Other scales and other readings that tell nothing, given all residuals: from their posterior,
  /// by Metropolis' and Gibbs' steps. Returns the zero's steps, drawn with them. `keeps_telling`:
  /// which readings tell stays as it is, no matter how far they are off.
  Eigen::VectorXd redraw(Random& random, bool keeps_telling = false);

  /// X' C^-1 X of columns X with a row for each reading, C the covariance of those that tell.
  Eigen::MatrixXd products(const Eigen::MatrixXd& columns) const;

  /// The sensor's range ended there: another profile leaves how far it is off as it is.
  bool is_bound(std::size_t reading) const {
    return !readings_->bounds.empty() && readings_->bounds[reading] != Bound::None;
  }
  double off(std::size_t reading) const { return off_[reading]; }

  double log_noise() const { return scales_.log_noise; }
  double growth_of_noise() const { return scales_.growth; }
  bool tells(std::size_t reading) const { return scatter_.precision[reading] > 0.0; }
  /// Those that do not, rising.
  std::vector<std::size_t> unheeded() const;
  /// How much less probable a reading is, by itself, than one that fits: at most as one that tells
  /// nothing.
  double lacking(std::size_t reading) const;
  /// Of the residuals and the scales.
  double log_density() const;

 private:
  struct Told;
  struct Marginal;

  double variance_of(std::size_t reading) const;
  double density(std::size_t reading, double noise) const;
  double wild_density(std::size_t reading) const;
  double mixed_density(std::size_t reading, double telling) const;
  Told told() const;
  Eigen::VectorXd sds(const ResidualScales& scales) const;
  Marginal marginal_of(const Told& told, const ResidualScales& scales) const;
  void redraw_growth(const Eigen::VectorXd& noise, Random& random);
  void redraw_telling(const Eigen::VectorXd& noise, Random& random);
  void redraw_bounded(const Eigen::VectorXd& noise, Random& random);
  void factor();

  const BackgroundTerms& terms() const { return readings_->background; }
  ToldAtEnd told_at_end(std::size_t reading) const;

  const OutlineReadings* readings_;
  ResidualPrior prior_;
  std::vector<double> off_;   // what was felt, less the profile,
  std::vector<double> told_;  // and what was told, where the sensor's range ended; else none
  ReadingScatter scatter_;
  Eigen::MatrixXd information_;  // that all readings have of the background
  ResidualScales scales_;
  Eigen::MatrixXd columns_;  // L^-1 S^(1/2) F' V^-1
  Eigen::VectorXd pull_;
  ResidualChange change_;
};

}  // namespace palpation
