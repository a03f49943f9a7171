/// Readings whose noise has heavier tails than a normal's.
#pragma once

#include <span>
#include <vector>

#include "palpation/belief/belief.h"

namespace palpation {

/// What a Student's t of four degrees of freedom makes of readings whose own noise is not given.
struct WeighedReadings {
  std::vector<Palpation> palpations;  ///< each with the noise variance that its residual leaves it
  double noise_sd = 0.0;              ///< the t's scale: that of a reading without a large residual
};

/// One round of expectation and maximization (Lange, Little and Taylor 1989) about a belief that
/// knows the palpations: with e the residual and v the field's variance at its place, a reading
/// weighs w = 5 / (4 + (e^2 + v) / s^2), its noise variance is s^2 / w, and the new s^2 is the mean
/// of w (e^2 + v).
WeighedReadings weighed_for_heavy_tails(const Belief& belief, std::span<const Palpation> palpations,
                                        double noise_sd);

/// The readings as they would be if their noise were normal and they had nothing else in common but
/// a constant: with the constant and scale that suit such a t best, each as far from the constant
/// as the root of its weight leaves it. A tumour keeps two scales, and many readings there agree; a
/// single one far out shows no more than noise does.
std::vector<Palpation> drawn_in(std::vector<Palpation> palpations);

}  // namespace palpation
