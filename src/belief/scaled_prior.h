/// A prior in reading units: readings that are standardized give it their spread and their mean.
#pragma once

#include <span>

#include "belief/sites.h"
#include "palpation/belief/belief.h"

namespace palpation {

struct ScaledPrior {
  Prior prior;
  BeliefOptions options;
  double spread = 1.0;  // of the readings, if standardized
  double centre = 0.0;  // prior mean of the constant

  double signal_sd() const { return prior.kernel().signal_sd * spread; }
  double signal_variance() const { return signal_sd() * signal_sd(); }
  /// Of a reading whose own is not given.
  double noise_variance() const;
  double constant_sd() const { return prior.constant().sd * spread; }
  /// What readings are counted from where a constant takes up the difference.
  double origin(std::span<const Site> sites) const;

  /// Takes the spread and the centre of these readings, where they are standardized.
  void standardize(std::span<const Palpation> palpations);
};

}  // namespace palpation
