/// Whether chains come to the same outlines.
#pragma once

#include <span>

#include "certainty/outline_walk.h"

namespace palpation {

/// Of draws of two chains, one after the other, as many of each: between the chains' mean depths at
/// places, over the draws' standard deviation there, root mean square. Of chains of n draws each
/// that know nothing of each other it is about (2 / n)^(1/2).
double disagreement_of(std::span<const OutlineDraw> draws, std::span<const Vec2> places);

}  // namespace palpation
