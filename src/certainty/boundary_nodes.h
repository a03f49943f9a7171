/// Places along a boundary, to sum over it.
#pragma once

#include <vector>

#include "certainty/layout.h"

namespace palpation {

struct BoundaryNodes {
  std::vector<SurfacePoint> points;
  std::vector<double> length_m;    ///< of the boundary, that each stands for
  std::vector<bool> follows_last;  ///< whether the node before lies on the same stretch
};

/// Places at most about 0.8 mm apart along { depth = 0 }, an eighth of the length over which
/// boundaries bend; the tissue's border is no boundary.
BoundaryNodes boundary_nodes(const Surface& surface, const Field& depth);

/// The nodes' values at all vertices: at each, the mean over the nearest nodes, their weight
/// falling over one spacing.
Field spread_from_nodes(const Layout& layout, const BoundaryNodes& nodes,
                        const Eigen::VectorXd& values);

}  // namespace palpation
