// The loop of a real robot: the library is asked for stops and told what was felt; the robot's loop
// stays the robot's. Usage: 05_ask_and_tell
#include <cstdio>

#include "palpation/palpation.h"

using namespace palpation;

namespace {

/// Stands for the robot: goes to the pose and reads the sensor. Here a disk of 6 mm radius is twice
/// as stiff as the rest.
double read_stiffness_at(const Vec3& contact) {
  return (contact - Vec3(0.012, 0.030, 0.0)).norm() < 0.006 ? 2.0 : 1.0;
}

}  // namespace

int main() {
  Random random(1);
  const Surface tissue(make_plane({.columns = 51, .rows = 101}, random));
  Exploration exploration(tissue, {.level = {.known = 1.5}},
                          {.initial = {.count = 12}, .batches = 6});

  for (std::vector<int> stops = exploration.next(); !stops.empty(); stops = exploration.next()) {
    std::vector<SurfacePoint> targets;
    for (int stop : stops) targets.push_back(tissue.at_vertex(stop));

    std::vector<Palpation> felt;
    for (const Waypoint& waypoint :
         waypoints(tissue, targets, {.standoff_m = 0.005, .indent_m = 0.002})) {
      Palpation palpation;
      palpation.where = waypoint.target;
      palpation.reading = read_stiffness_at(waypoint.position);
      palpation.batch = exploration.batch();
      felt.push_back(palpation);
    }
    exploration.record(felt);
    std::printf("batch %d: %zu stops\n", exploration.batch() - 1, stops.size());
  }
  const Region stiff = superlevel_region(tissue, exploration.conclusion().marginals.mean,
                                         exploration.conclusion().level->value);
  std::printf("%s; the stiff part has %.0f mm2 of 113\n", exploration.stop_reason().c_str(),
              stiff.area() * 1e6);
}
