/// Where the search for a surface's slow waves starts: vectors that are as if random, but follow
/// from the surface alone.
#pragma once

#include <vector>

#include "geometry/block_solver.h"

namespace palpation {

/// What the start is made with: G and M in the order of the factor of G + shift M.
struct ShiftedLaplacian {
  const Eigen::SparseMatrix<double>& stiffness;
  const Eigen::SparseMatrix<double>& mass;
  const BlockFactor& factor;
  double shift;
};

/// So many strips of vectors that look white over the surface.
///
/// On an irregular mesh they are functions of the shapes of its triangles: each vertex' weight and
/// area, spread over the neighbourhood, and folded into many waves. So they move along when
/// vertices get other numbers, and all that is found from them does. Where the mesh is so regular
/// that vertices are alike (on a grid, a mirrored half, one of two equal components), such
/// functions could not tell those apart, and they are random signs by the numbers of the vertices.
std::vector<Strip> start_block(const ShiftedLaplacian& laplacian, int strips);

}  // namespace palpation
