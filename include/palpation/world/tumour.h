/// Shapes of tumours as seen on the tissue, and how far a place is from their outline.
#pragma once

#include <span>
#include <variant>
#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

/// All places within a radius of a centre, along the surface.
struct Disk {
  Vec3 centre_m = Vec3::Zero();
  double radius_m = 0.0;
};

/// All places within half_width of an arc of a circle, so its caps are round. `facing` points from
/// the centre to the middle of the arc. On curved tissue the arc is drawn in the tangent plane at
/// the centre and each of its points taken to the closest surface point.
struct Horseshoe {
  Vec3 centre_m = Vec3::Zero();
  double arc_radius_m = 0.0;
  double half_width_m = 0.0;
  double arc_rad = 3.14159265358979323846;  ///< the solid part
  Vec3 facing = Vec3::UnitX();              ///< projected to the tangent plane at the centre
};

/// A closed outline through points, each taken to its closest surface point, joined by shortest
/// surface paths; the last may repeat the first. Curved tissue must have a chart: distances from
/// the outline are those in it. Points are rounded to a picometre there.
struct Outline {
  std::vector<Vec3> points_m;
};

using Tumour = std::variant<Disk, Horseshoe, Outline>;

/// Distance along the surface from every vertex to the nearest outline, metres, positive inside a
/// tumour. With several tumours the nearest outline of their union as single shapes counts: the
/// greatest of their signed distances. Without any: minus infinity everywhere.
///
/// On planar tissue shapes live in its plane, also beyond the border, which may cut them: distances
/// are straight and exact, without a search tree. Elsewhere they are those of distance_from (to a
/// horseshoe's arc: from places so close on it that its outline is exact to a ten-thousandth of its
/// half width). Throws InvalidInput naming the tumour's number (from 1) and the rule: radii and
/// widths positive and finite, half_width below arc_radius, on curved tissue arc_radius at most the
/// tissue's diameter, 0 < arc <= 2 pi, `facing` not along the normal, an outline of at least three
/// distinct and at most 10,000 points that does not cross or touch itself, centres and an outline's
/// points no farther from the surface than 5 mm.
Field signed_distance(const Surface& surface, std::span<const Tumour> tumours);

}  // namespace palpation
