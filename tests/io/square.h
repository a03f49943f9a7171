/// The smallest tissue that readings and boundaries can lie on.
#pragma once

#include "palpation/geometry/surface.h"

namespace palpation {

/// A square of 2 x 2 cm in the plane z = 0, two triangles.
inline Surface square() {
  TriangleMesh mesh;
  mesh.vertices.resize(4, 3);
  mesh.vertices << 0, 0, 0, 0.02, 0, 0, 0.02, 0.02, 0, 0, 0.02, 0;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  return Surface(mesh);
}

}  // namespace palpation
