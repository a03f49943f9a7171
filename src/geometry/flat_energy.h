/// What a flattening is measured by: energies of the map from each triangle of the tissue to the
/// plane.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpation/geometry/triangle_mesh.h"

namespace palpation {

/// A triangle of the tissue laid in a plane of its own.
struct FlatTriangle {
  Eigen::Matrix2d to_plane;  ///< inverse of the matrix of its edges from the first corner: a map's
                             ///< Jacobian is (edges in uv) * to_plane
  double area = 0.0;
};

/// All triangles. Slivers thinner than a ten-thousandth of their longest edge are taken that thick,
/// or their weights would drown all others': cotangents stay below 1e4.
std::vector<FlatTriangle> flat_triangles(const TriangleMesh& mesh);

/// The Jacobian of the map from a triangle to uv.
Eigen::Matrix2d jacobian(const FlatTriangle& flat, const Triangles& triangles, Eigen::Index face,
                         const Points2& uv);

enum class FlatEnergy {
  Rigid,  ///< sum of area |J - R|^2, R the rotation next to J (Liu et al. 2008): as little stretch
          ///< as can be, triangles may turn over
  Barrier,  ///< sum of area (|J|^2 + |J^-1|^2) (Smith and Schaefer 2015): infinite where a triangle
            ///< is about to turn over
};

/// The energy at uv, and its gradient.
double energy_at(FlatEnergy energy, const std::vector<FlatTriangle>& flat,
                 const Triangles& triangles, const Points2& uv, Points2& gradient);

/// How far uv can move along `step`, in steps, until the first triangle has no area; infinite if
/// none ever does.
double way_to_first_turn(const Triangles& triangles, const Points2& uv, const Points2& step);

}  // namespace palpation
