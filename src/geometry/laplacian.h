/// The Laplace-Beltrami operator of a triangle mesh, from the lengths of its edges alone: what a
/// surface is like to walk on.
///
/// Linear elements (Pinkall and Polthier 1993): G the cotangent stiffness, M three parts of the
/// lumped and five of the consistent mass, whose discretization errors have opposite signs: on
/// jittered meshes, where equal parts are not best, the heat kernel's error is then a third of what
/// lumping leaves. Both after flips to the intrinsic Delaunay triangulation (Bobenko and Springborn
/// 2007), without which stretched triangles give weights of the wrong sign. Triangles that are no
/// more than a line (area below 1e-9 of the longest edge's square, or sides that no triangle has)
/// count with that area.
#pragma once

#include <Eigen/SparseCore>
#include <functional>

#include "palpation/geometry/surface.h"

namespace palpation {

/// Triangles by the lengths of their edges, glued along them. It needs no place in space, and may
/// glue what space could not.
struct MetricMesh {
  using Lengths = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

  int vertex_count = 0;
  Triangles triangles;  ///< m x 3, counter-clockwise
  Lengths lengths;      ///< m x 3: of the edge from corner i to corner i+1 (mod 3)
  Triangles across;  ///< m x 3: 3 * face + corner of the same edge in the next triangle, which runs
                     ///< through it backwards; -1 at a border
};

/// The surface as it is, edge by edge.
MetricMesh metric_of(const Surface& surface);

/// Triangles glued wherever two share a pair of vertices. Throws InvalidInput if more than two do,
/// or a length is not positive and finite.
MetricMesh glued(int vertex_count, const Triangles& triangles, const MetricMesh::Lengths& lengths);

/// Flips edges until opposite angles add up to no more than pi.
void flip_to_delaunay(MetricMesh& mesh);

/// The same, but an edge stays where its two faces may not trade.
void flip_to_delaunay(MetricMesh& mesh, const std::function<bool(int face, int beyond)>& may_trade);

struct Laplacian {
  Eigen::SparseMatrix<double> stiffness;  ///< G, no unit
  Eigen::SparseMatrix<double> mass;       ///< M, m2
};
Laplacian laplacian_of(const MetricMesh& mesh);

/// Area of a face, m2, and the angle at its corner, rad.
double area_of(const MetricMesh& mesh, int face);
double angle_of(const MetricMesh& mesh, int face, int corner);

}  // namespace palpation
