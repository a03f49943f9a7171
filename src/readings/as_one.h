/// Readings of one place, or nearly, as one.
#pragma once

#include <span>

#include "palpation/geometry/surface.h"
#include "palpation/readings/palpation.h"

namespace palpation {

/// The reading's own variance, or where it has none, what is given.
double variance_of(const Palpation& palpation, double noise_variance);

/// Whether they differ by no more than noise makes 95 % of those of one plateau differ.
bool are_alike(const Palpation& some, const Palpation& others, double noise_variance);

struct AsOne {
  Palpation palpation;  ///< the first one's place
  Vec3 shift_m;         ///< from there to the middle
};
/// The mean by precision, with the precisions added up. Variances must be positive.
AsOne as_one(const Surface& surface, std::span<const Palpation> together, double noise_variance);

}  // namespace palpation
