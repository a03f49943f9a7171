/// Tumours of any shape: for runs that must not know the shape beforehand.
///
/// Star: r(angle) = r0 (1 + a random Fourier series of the harmonics 2 to 5). Bent: a band along an
/// arc of 60 to 220 degrees whose half width varies along it, with round ends: from beans to
/// horseshoes. Ellipse: up to three times as long as wide. Their reach, the greatest radius of
/// balls that roll along both sides everywhere, bounds curvature and the width of necks and gaps
/// from below. Dumbbell: two disks and a neck; Ell, with one inner corner; Pointed, stars of three
/// to seven points; Crescent, with two horns: these have corners and no reach, and are drawn only
/// where the options ask for none.
#pragma once

#include "palpation/base/random.h"
#include "palpation/world/tumour.h"

namespace palpation {

enum class ShapeFamily { Star, Bent, Ellipse, Dumbbell, Ell, Pointed, Crescent };

struct RandomShapeOptions {
  Vec2 size_m = Vec2(0.054, 0.049);  ///< of the search area, from the origin along x and y (that of
                                     ///< Garg et al. 2016, section VII)
  double margin_m = 0.002;           ///< between the outline and the border
  double least_area_m2 = 0.5e-4;     ///< areas are uniform from here ...
  double most_area_m2 = 4e-4;        ///< ... to here
  double least_reach_m = 0.0015;  ///< a curve sharper than the edge is wide (one slope length and
                                  ///< more) could not be felt; 0: corners, too
};

/// An outline in the plane z = 0 of at most a millimetre between points, counter-clockwise, inside
/// the search area. The same stream draws the same shape. Throws InvalidInput unless lengths and
/// areas are positive and finite, the margin not negative and least <= most <= a quarter of what
/// the margins leave, and where a thousand draws find no shape of such a reach.
Outline random_shape(ShapeFamily family, Random& random, const RandomShapeOptions& options = {});

/// Area within an outline in the plane z = 0, positive if counter-clockwise.
double signed_area(const Outline& outline);
double perimeter(const Outline& outline);
/// The least of |b - a|^2 / (2 x distance of b from the tangent at a) over all pairs of points
/// (Federer 1959): no circle of a smaller radius touches the outline twice. Infinite for a straight
/// line.
double reach(const Outline& outline);

}  // namespace palpation
