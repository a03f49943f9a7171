/// Charts of curved disks.
#pragma once

#include <string>
#include <vector>

#include "geometry/check_mesh.h"
#include "palpation/geometry/chart.h"
#include "palpation/geometry/triangle_mesh.h"

namespace palpation {

/// A chart, or why there is none.
struct Flattened {
  Chart chart;
  std::string fault;  ///< empty where the chart is good
};

/// Lays a disk flat as chart.h says. `area` and `diameter` are the mesh's.
Flattened flatten(const TriangleMesh& mesh, const Connectivity& connectivity,
                  const std::vector<std::vector<int>>& border_loops, double area, double diameter);

}  // namespace palpation
