// What can be asked of a tissue surface: topology, areas, normals, closest points.
// Usage: 02_a_surface
#include <cstdio>

#include "palpation/palpation.h"

using namespace palpation;

int main() {
  Random random(1);
  const Surface tissue(
      make_plane({.size_m = Vec2(0.025, 0.050), .columns = 26, .rows = 51, .jitter = 0.3}, random));
  const Topology topology = tissue.topology();
  std::printf("%d vertices, %d triangles, %d border, %.2f cm2\n", tissue.vertex_count(),
              tissue.face_count(), topology.borders, tissue.area() * 1e4);

  // A place 2 mm above the tissue, and where the probe would meet it.
  const SurfacePoint below = tissue.project(Vec3(0.010, 0.020, 0.002));
  const Vec3 p = tissue.position(below);
  const Vec3 n = tissue.normal(below);
  std::printf("closest point (%.1f, %.1f, %.1f) mm, normal (%.0f, %.0f, %.0f)\n", p.x() * 1e3,
              p.y() * 1e3, p.z() * 1e3, n.x(), n.y(), n.z());

  std::printf("computed on the way:");
  for (const std::string& what : tissue.computed()) std::printf(" %s", what.c_str());
  std::printf("\n");
}
