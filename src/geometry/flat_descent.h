/// From a flattening to the best one near it.
#pragma once

#include "geometry/flat_energy.h"

namespace palpation {

/// Descends from `start` to where the energy is least. Local and global steps of Liu et al. (2008)
/// are steepest descent in the metric of the cotangent Laplacian, which is factored once; here the
/// same metric starts the limited-memory quasi-Newton updates of Nocedal (1980; with the Laplacian:
/// Liu et al. 2017), which need a tenth of the steps. Ends when a step moves nothing by more than
/// 1e-12 of the mesh's size, or after 1,000. With the barrier no triangle is turned over that was
/// not from the start. The mesh should measure about 1.
Points2 descended(FlatEnergy energy, const TriangleMesh& mesh, Points2 start);

}  // namespace palpation
