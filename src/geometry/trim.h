/// What is left of a triangulation of points where they are close enough together: private to the
/// making of a surface from points.
#pragma once

#include <vector>

#include "palpation/geometry/triangle_mesh.h"

namespace palpation {

/// Diameter of the circle through each triangle's corners; infinite where they lie on a line.
Field circle_widths(const TriangleMesh& mesh);

/// The step of a square lattice that has such triangles: see reconstruct.h.
double sample_spacing(const TriangleMesh& mesh);

/// Whether what is folded over its neighbour stays with it.
enum class Folds { Keep, Part };

/// The triangles whose circles are no wider than most_m; where folds part and one lies back over
/// its neighbour by more than a right angle, as a front does that has run over a rim, they are
/// parted. Without patches smaller than a twentieth of the largest, and without what hangs on by a
/// single vertex. The mesh must have at most two triangles at an edge. Unused vertices are dropped;
/// `kept` has the number of each that is left.
struct Trimmed {
  TriangleMesh mesh;
  std::vector<int> kept;
};
Trimmed trim(const TriangleMesh& mesh, double most_m, Folds folds);

/// Turns components round until each faces the way that its vertices' directions point, a closed
/// one for which they do not tell away from its inside.
void face_outward(TriangleMesh& mesh, const Points& outward);

/// The mesh without its shortest bumps: along `along` (zero: each vertex' normal) vertices move to
/// where
///     sum |x - x0|^2 + 16 scale^4 sum |mean of neighbours - x|^2
/// is least, the second sum over inner vertices: a thin plate, free at its borders. scale: in mean
/// edge lengths.
TriangleMesh fair(TriangleMesh mesh, double scale, const Vec3& along);

}  // namespace palpation
