/// How much steeper an edge is on some sides of a tumour than on others.
///
/// The slope's logarithm, over that in the middle, is that of a wave around the tumour and of one
/// that is twice as short: steeper towards a side, and towards two opposite ones. How high waves
/// are is a scale that is unknown beforehand, the same for both but half as much for the second: an
/// edge is mostly as steep on all sides within a factor of two, but what spreads into tissue on one
/// side and ends sharply on the other is no rarity of many standard deviations.
#pragma once

#include <Eigen/Core>

#include "palpation/base/random.h"
#include "palpation/base/types.h"

namespace palpation {

/// Towards a side, and, by the angle doubled, towards two.
using Lean = Eigen::Vector4d;

/// Of the slope at a place, so far from the tumour's middle, over that in the middle. Nearly its
/// side's from `radius_m` on.
double log_steepness(const Lean& lean, const Vec2& off_m, double radius_m);

/// Student's law of four numbers, two degrees of freedom; its logarithm, and one drawn from it.
double log_density(const Lean& lean);
Lean draw_lean(Random& random);

}  // namespace palpation
