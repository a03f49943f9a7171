/// The smallest tissue that readings and boundaries can lie on.
#pragma once

#include "palpation/geometry/surface.h"

namespace palpation {

/// A square in a plane z = height, two triangles.
inline Surface square(double side_m = 0.02, double height_m = 0.0) {
  TriangleMesh mesh;
  mesh.vertices.resize(4, 3);
  mesh.vertices << 0, 0, height_m, side_m, 0, height_m, side_m, side_m, height_m, 0, side_m,
      height_m;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  return Surface(mesh);
}

}  // namespace palpation
