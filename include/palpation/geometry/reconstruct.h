/// A smooth surface near contact points, from the points alone: where tissue is, how far it goes,
/// and which side is out. It is the reference over which heights are measured
/// (certainty in them comes from belief/height.h), not yet the surface itself.
///
/// 1. Thinned (thin.h) to some thousand points; single ones more than two sample spacings off the
///    plane of their neighbours, and ten times what is usual, are outliers and left out.
/// 2. Triangulated: Delaunay as seen along the normal of the plane through them, where hardly any
///    of it is steeper than 72 degrees then; else by CGAL's advancing front, after jets have
///    smoothed the points. Poisson's reconstruction closes every border, and so is none of these.
/// 3. Trimmed: a triangle whose circumscribed circle is wider than `gap` sample spacings spans what
///    nobody touched, and goes. So borders may be concave, holes are left open, and a cliff between
///    two layers parts them. Patches smaller than a twentieth of the largest go too.
/// 4. Meshed evenly, and faired: shorter than some `fairing` spacings it has no bumps.
///
/// The sample spacing: half the diagonal's share of the circles through neighbouring points, the
/// median over all; on a square lattice its step, on a raster of dense lines .7 of their distance.
#pragma once

#include <vector>

#include "palpation/geometry/triangle_mesh.h"

namespace palpation {

enum class Triangulation { Chosen, Projection, AdvancingFront };

struct ReconstructOptions {
  Triangulation by = Triangulation::Chosen;
  double gap = 4.0;        ///< widest empty circle that is spanned, in sample spacings
  double edge_m = 0.0;     ///< of the mesh; 0: half a spacing, longer where that would take more
                           ///< than 20,000 vertices
  double fairing = 1.5;    ///< in sample spacings
  int most_points = 3000;  ///< that are triangulated; the others are thinned to these
};

struct Reconstruction {
  TriangleMesh mesh;  ///< a valid surface; one or several components, the probe's side outward
  Triangulation by = Triangulation::Projection;
  double spacing_m = 0.0;
  double edge_m = 0.0;
  double thinned_m = 0.0;     ///< radius within which points were joined; 0: none were
  std::vector<int> outliers;  ///< points far off their neighbours, rising
};

/// outward: n x 3, for each point a direction on the side from where the probe came, of any length
/// but zero. Throws InvalidInput unless sizes agree and all is finite, with fewer than 12 different
/// points, with points on one line, if an option is out of its range (gap at least 1.5, fairing at
/// least .5, edge not negative) or edge_m would take more than a million vertices; NumericalError
/// where no valid surface comes of the points, or CGAL fails.
Reconstruction reconstruct(const Points& points, const Points& outward,
                           const ReconstructOptions& options = {});

}  // namespace palpation
