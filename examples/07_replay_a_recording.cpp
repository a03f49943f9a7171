// A dense recording as a world: touches are answered by what was once felt there, and not at all
// where the robot never was. Usage: 07_replay_a_recording
#include <cmath>
#include <cstdio>

#include "palpation/palpation.h"

using namespace palpation;

int main() {
  Random random(1);
  const Surface tissue(make_plane({.columns = 51, .rows = 101}, random));

  // Rows 1 mm apart over a round stiff spot, as a robot would record them; the last 10 mm of the
  // tissue were never scanned.
  RecordedReadings scan{Points(26 * 81, 3), Eigen::VectorXd(26 * 81)};
  for (int i = 0; i < 26 * 81; ++i) {
    const Vec3 p(0.001 * (i / 81), 0.0005 * (i % 81), 0.0);
    scan.positions.row(i) = p;
    scan.readings[i] =
        7000.0 + 2000.0 / (1.0 + std::exp(1400.0 * ((p - Vec3(0.012, 0.020, 0.0)).norm() - 0.006)));
  }
  const RecordedWorld world(tissue, {scan});
  const std::optional<Palpation> inside =
      world.touch(tissue.at_vertex(tissue.nearest_vertex(Vec3(0.012, 0.020, 0.0))), Vec3::Zero());
  const std::optional<Palpation> beyond =
      world.touch(tissue.at_vertex(tissue.nearest_vertex(Vec3(0.012, 0.049, 0.0))), Vec3::Zero());
  std::printf("over the spot %.0f, beyond the scan %s\n", inside->reading,
              beyond ? "a reading" : "no contact");

  Exploration exploration(tissue, {.level = {.known = 8000.0}}, {}, {.touch_once = true});
  run(exploration,
      [&](const SurfacePoint& where, const Vec3& travel) { return world.touch(where, travel); });
  const Region found = superlevel_region(tissue, exploration.conclusion().marginals.mean,
                                         exploration.conclusion().level->value);
  std::printf("%zu part, %.0f mm2 (a disk of 6 mm radius has 113)\n", found.polygons().size(),
              found.area() * 1e6);
}
