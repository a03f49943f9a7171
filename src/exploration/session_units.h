/// Sessions whose readings are in another unit, or of another sensor.
#pragma once

#include <span>
#include <vector>

#include "palpation/certainty/misfit.h"

namespace palpation {

/// The gain of each session whose readings rise and fall with those beside them of the sessions
/// before, but by more than three times as much, or less than a third: what outlines find of a gain
/// by themselves is less (outline_start.cpp). Too few of them tell nothing, nor do those of one
/// plateau.
std::vector<Misfit> session_units(const Surface& surface, std::span<const Palpation> palpations);

}  // namespace palpation
