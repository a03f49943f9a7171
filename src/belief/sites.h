/// Readings gathered by place: repeated touches of one site can be one row of the model, exactly.
///
/// For readings y_k of variance v_k at one place, the posterior depends on their precision-weighted
/// mean and on sum 1/v_k alone; the likelihood also on their scatter, which
/// `scatter_log_likelihood` adds (RELIABILITY: merging is both speed and stability).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "palpation/belief/prior.h"
#include "palpation/readings/palpation.h"

namespace palpation {

struct Site {
  SurfacePoint where;
  Place place;
  std::vector<double> plain;            ///< readings whose noise is the field's
  std::vector<double> known;            ///< readings whose noise variance is known ...
  std::vector<double> known_variances;  ///< ... and those variances
  std::vector<Made> made{};             ///< of all its readings, in their order
};

/// One site per distinct place of the palpations that are not set aside, in order of first touch;
/// of those from number `first` on. Throws InvalidInput naming the palpation's number if a reading
/// is not finite or a variance negative or infinite.
std::vector<Site> gather_sites(const Prior& prior, std::span<const Palpation> palpations,
                               std::size_t first = 0);

/// A site's readings as one, where the field's noise has the given variance.
struct MergedReading {
  double mean = 0.0;
  double variance = 0.0;
};
/// Throws InvalidInput if readings without noise contradict each other.
MergedReading merge(const Site& site, double field_noise_variance);

/// What merging takes out of the log likelihood: log of the density of the readings given their
/// merged mean.
double scatter_log_likelihood(const Site& site, double field_noise_variance);

}  // namespace palpation
