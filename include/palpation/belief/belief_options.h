/// What a belief takes readings for, and what it may spend on them.
#pragma once

namespace palpation {

struct BeliefOptions {
  double noise_sd = 0.0;           ///< of a reading whose own variance is not given
  bool noise_is_relative = false;  ///< noise_sd is a fraction of the kernel's signal_sd

  /// The kernel's signal_sd, the constant's sd and the slope's are multiples of the readings'
  /// standard deviation, and the constant's mean is the readings' mean: outputs z-scored, as GPy
  /// does.
  bool standardize = false;

  /// Of the prior's variance, the part that may be left out so that many readings cost no more than
  /// a few hundred; 0: none. Smooth kernels gain, rough ones stay exact.
  double reduced_rank_tolerance = 0.0;

  /// Rows over the vertices are kept in single precision, half as large; all arithmetic stays in
  /// double. Mean and variance are off by less than 1e-4 of the signal's.
  bool single_precision = false;
};

/// Noise variance over the signal's, of any reading, below which reduced rank is left aside for the
/// exact belief: so many times BeliefOptions::reduced_rank_tolerance, since the bound on what is
/// lost grows with the tolerance over the noise.
inline constexpr double kLeastNoiseForReducedRank = 1e5;

/// Noise variance over the signal's, of a reading, below which single precision would cost more
/// than it saves: refused.
inline constexpr double kLeastNoiseForSingle = 1e-3;

}  // namespace palpation
