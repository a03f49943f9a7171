// A stranger's program: other flags than the library's, no header but its own. What holds Eigen
// types crosses the border by value, both ways: what one side allocates the other frees, and
// fixed-size members must lie at the same offsets. AddressSanitizer and the checks below see to it.
#include <palpation/belief/belief.h>
#include <palpation/boundary/level_set.h>
#include <palpation/exploration/waypoint.h>
#include <palpation/geometry/make_plane.h>
#include <palpation/io/read_mesh.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

using namespace palpation;

namespace {

static_assert(
    alignof(Robot) == 16,
    "Eigen's alignment is the library's, whatever vector instructions the consumer may use");

void check(bool holds, const char* claim) {
  if (holds) return;
  std::fprintf(stderr, "not so: %s\n", claim);
  std::exit(1);
}

TriangleMesh two_triangles_of_my_own() {
  TriangleMesh mesh{Points(4, 3), Triangles(2, 3)};
  mesh.vertices << 0, 0, 0, 0.01, 0, 0, 0.01, 0.01, 0, 0, 0.01, 0;
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  return mesh;
}

TriangleMesh through_a_file(const TriangleMesh& mesh) {
  write_mesh("plane.ply", mesh, LengthUnit::Millimetre);
  return read_mesh("plane.ply", LengthUnit::Millimetre).mesh;
}

Palpation touch(const SurfacePoint& where, double reading) {
  Palpation palpation;
  palpation.where = where;
  palpation.reading = reading;
  return palpation;
}

/// Soft at the first vertex, stiff at the last: what the belief makes of two touches.
Marginals after_two_touches(const Surface& surface) {
  const Prior prior(surface, Metric::Ambient, {.length_m = 0.01, .signal_sd = 1.0});
  const std::vector<Palpation> touches{touch(surface.at_vertex(0), -1.0),
                                       touch(surface.at_vertex(surface.vertex_count() - 1), 1.0)};
  const Belief before(prior, {.noise_sd = 0.01});
  Belief after = before;
  after = after.condition_on(touches);
  return after.at_vertices();
}

}  // namespace

int main() {
  const Surface mine(refine(two_triangles_of_my_own(), 0.002));
  check(std::abs(mine.area() - 1e-4) < 1e-16,
        "a square of 10 mm has 100 mm2");  // rounding of 1e-4 is 1e-20

  Random random(1);
  const TriangleMesh theirs =
      make_plane({.size_m = {0.025, 0.050}, .columns = 6, .rows = 11}, random);
  const Surface surface(through_a_file(theirs));

  const Field mean = after_two_touches(surface).mean;
  check(mean.size() == surface.vertex_count() && mean(0) < -0.5 && mean(mean.size() - 1) > 0.5,
        "the belief follows the touches");
  const Region stiff = superlevel_region(surface, mean, 0.0);
  check(stiff.area() > 0.0 && stiff.area() < surface.area(), "a part of the tissue is stiff");

  Robot robot;
  robot.from_tissue(2, 3) = 0.1;
  const std::vector<SurfacePoint> targets{surface.project({0.0125, 0.025, 0.5})};
  const Waypoint waypoint = waypoints(surface, targets, robot).front();
  check((waypoint.position - Vec3(0.0125, 0.025, 0.1)).norm() < 1e-9,
        "the waypoint is below the point");  // the file keeps 1e-12 m
  const Eigen::Vector4d facing_down = quaternion(waypoint.rotation);
  check(std::abs(facing_down.norm() - 1.0) < 1e-12, "a pose has a unit quaternion");

  std::printf("25 x 50 mm of tissue: %.3f mm2\n", 1e6 * surface.area());
  return 0;
}
