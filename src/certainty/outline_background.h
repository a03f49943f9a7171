/// What healthy tissue and the sensor add to readings beside a plateau: slow waves over the tissue,
/// and a zero that drifts from batch to batch.
///
/// The waves are a Gaussian field, by sines in a rectangle around the readings (Solin and Sarkka
/// 2020); how high they are is learned. Both are linear in coefficients that are normal, so that
/// they are drawn at once from what they are given all else.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "palpation/base/random.h"
#include "palpation/base/types.h"

namespace palpation {

/// What one unit of each coefficient adds to each reading: rows are readings, columns terms. The
/// last is the drift, one unit from the first batch to the last.
struct BackgroundTerms {
  Eigen::MatrixXd of_readings;
  double median_sd = 1.0;  ///< of the waves beforehand, in reading units; the spread of its
                           ///< logarithm is 1
  double drift_sd = 1.0;   ///< in reading units
};
/// `when`: of each reading, any number that rises as time goes on.
BackgroundTerms background_terms(std::span<const Vec2> places, std::span<const double> when);

class OutlineBackground {
 public:
  /// None.
  OutlineBackground() = default;
  /// Of all coefficients 0. The terms must outlive it.
  explicit OutlineBackground(const BackgroundTerms& terms);

  bool is_none() const { return coefficients_.size() == 0; }
  /// What is added to a reading.
  double at(std::size_t reading) const { return added_.empty() ? 0.0 : added_[reading]; }
  double waves_sd() const;

  /// Another one, given how far readings are off without it and their precisions (0: such a reading
  /// tells nothing). First the waves' sd, all coefficients integrated out, then these.
  void draw(const Eigen::VectorXd& off, const Eigen::VectorXd& precision, Random& random);

  /// Of coefficients and sd.
  double log_density() const;

 private:
  Eigen::VectorXd sds(double log_sd) const;

  const BackgroundTerms* terms_ = nullptr;
  Eigen::VectorXd coefficients_;
  double log_sd_ = 0.0;  // of the waves over its median
  std::vector<double> added_;
};

}  // namespace palpation
