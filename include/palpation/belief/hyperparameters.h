/// Length, signal and noise of the field, learned from the readings.
///
/// Restricted maximum likelihood (or plain, where the constant has a prior of its own) plus
/// physical priors, as a maximum a posteriori estimate:
///   log length ~ N(log length_median, length_spread^2)       without it one run in four loses the
///   tumour; log (noise / signal)^2 ~ N(log 0.02, 2^2)                only where both are learned;
///   signal >= a quarter of the readings' range               half of half the contrast: a field
///   that does not explain it is no field;
///                                                            where the prior has a slope, of the
///                                                            range around the best plane.
/// The optimizer is NLopt's L-BFGS with the exact gradient, started from the given values and from
/// the priors' medians; the better optimum counts.
#pragma once

#include <optional>
#include <span>

#include "palpation/belief/belief.h"

namespace palpation {

struct Hyperparameters {
  double length_m = 0.0;
  double signal_sd = 0.0;  ///< reading units
  double noise_sd = 0.0;   ///< of readings whose own variance is not given, reading units
};

struct LearnOptions {
  std::optional<double> length_m{};   ///< fixed, not learned
  std::optional<double> signal_sd{};  ///< fixed
  std::optional<double> noise_sd{};   ///< fixed
  double length_median_m = 0.0035;    ///< of the length's prior
  double length_spread = 0.4;         ///< standard deviation of log length
  /// The values are rounded to the coarsest grid of their logarithms that costs at most so many
  /// nats of log posterior: more readings then often teach the very same ones. 0: they are the
  /// best.
  double rounding_nats = 0.0;
  bool likelihood_alone =
      false;  ///< no priors, a signal of any size, one start: what other programs do
};

struct Learned {
  Hyperparameters values;
  double log_posterior = 0.0;    ///< log likelihood plus log priors, up to the priors' constants
  double signal_evidence = 0.0;  ///< log likelihood ratio of this field to noise alone around a
                                 ///< constant, or a plane where the prior has a slope
  double gain =
      0.0;  ///< of log posterior over that at the start; infinite where the start is out of bounds
};

/// `prior` says metric, kernel family and constant; its hyperparameters are where the search
/// starts. Readings that are set aside do not count. Throws InvalidInput with fewer than two sites
/// or if a fixed value is not positive and finite (noise may be 0), NumericalError if no start
/// gives a finite likelihood.
Learned learn(const Prior& prior, std::span<const Palpation> palpations,
              const Hyperparameters& start, const LearnOptions& options);

}  // namespace palpation
