// The next stops as poses in a robot's frame: approach, contact, indentation, and the probe's
// rotation. Usage: 08_plan_for_a_robot
#include <cstdio>

#include "palpation/palpation.h"

using namespace palpation;

int main() {
  Random random(1);
  const Surface tissue(make_plane({.columns = 26, .rows = 51}, random));
  Exploration exploration(tissue, {}, {.initial = {.count = 4}});

  // The tissue lies 100 mm in front of the robot, face up, turned by a right angle.
  Robot robot;
  robot.from_tissue << 0, -1, 0, 0.100,  //
      1, 0, 0, 0.000,                    //
      0, 0, 1, 0.050,                    //
      0, 0, 0, 1;
  std::vector<SurfacePoint> targets;
  for (int stop : exploration.next()) targets.push_back(tissue.at_vertex(stop));
  for (const Waypoint& pose : waypoints(tissue, targets, robot)) {
    const Vec3 approach = pose.approach * 1e3, indented = pose.indented * 1e3;
    const Eigen::Vector4d q = quaternion(pose.rotation);
    std::printf(
        "from (%.0f, %.0f, %.0f) to (%.0f, %.0f, %.0f) mm, quaternion (%.2f, %.2f, %.2f, %.2f), "
        "expect at most %.2f N\n",
        approach.x(), approach.y(), approach.z(), indented.x(), indented.y(), indented.z(), q[0],
        q[1], q[2], q[3], pose.expected_force_n);
  }
}
