/// Readings of a sensor that counts in steps.
#pragma once

#include <optional>
#include <span>

#include "palpation/readings/palpation.h"

namespace palpation {

/// The least by which two of the readings differ: a sensor's step. Nothing where fewer than half of
/// the readings repeat another's value, there are fewer than ten, or all are equal.
std::optional<double> step_of(std::span<const double> readings);

/// The variance that rounding to the readings' own step adds, step^2 / 12 (Sheppard): less than
/// this no noise can be taken to be, though readings on a plateau be alike to the last digit. 0
/// where they have no step, or only two values: healthy and stiff, as they are without noise.
/// Readings that are set aside do not count.
double rounding_variance(std::span<const Palpation> palpations);

}  // namespace palpation
