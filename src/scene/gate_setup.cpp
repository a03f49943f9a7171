#include "scene/gate_setup.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "palpation/base/contract.h"
#include "scene/bound_keys.h"
#include "scene/registration_file.h"
#include "scene/setup.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

/// Around the tissue, where the scene gives no box: room to travel and to lift.
constexpr double kAroundTissue_m = 0.02;
/// No tissue is known better.
constexpr double kLeastUncertainty_m = 1e-5;
/// No arm of a surgical robot reaches farther.
constexpr double kFarthest_m = 10.0;

void take_box(const Scene& scene, const Surface& surface, GateLimits& limits) {
  const Robot robot = robot_of(scene);
  const Eigen::Isometry3d to_robot(robot.from_tissue);
  const double far_m = std::numeric_limits<double>::infinity();
  Vec3 least = Vec3::Constant(far_m), most = Vec3::Constant(-far_m);
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    const Vec3 place = to_robot * surface.vertex(vertex);
    least = least.cwiseMin(place);
    most = most.cwiseMax(place);
  }
  if (std::max(least.cwiseAbs().maxCoeff(), most.cwiseAbs().maxCoeff()) > kFarthest_m)
    scene.refuse("robot.from_tissue",
                 "puts the tissue " + fixed(most.norm(), 1) +
                     " m from the robot's base: its translation is in metres. Is it millimetres?");
  const double around_m = kAroundTissue_m + robot.standoff_m + robot.indent_m;
  limits.box_least = least - Vec3::Constant(around_m);
  limits.box_most = most + Vec3::Constant(around_m);
  if (!scene.gives("robot.limits.box_mm")) return;
  const std::vector<double> box = scene.numbers("robot.limits.box_mm");
  limits.box_least = Vec3(box[0], box[1], box[2]) / 1000.0;
  limits.box_most = Vec3(box[3], box[4], box[5]) / 1000.0;
}

void refuse_broken(const Scene& scene, const GateLimits& limits) {
  try {
    check(limits);
  } catch (const InvalidInput& error) {
    scene.refuse("robot.limits", rule_words(error));
  }
}

}  // namespace

void check_limits(const Scene& scene) {
  GateLimits limits = bound(scene, limit_keys());
  limits.box_most = Vec3::Ones();  // the tissue's, where there is one
  refuse_broken(scene, limits);
}

GateLimits gate_limits_of(const Scene& scene, const Surface& surface) {
  GateLimits limits = bound(scene, limit_keys());
  const auto registration = registration_of(scene);
  if (registration && !scene.gives("robot.uncertainty_mm"))
    limits.uncertainty_m = std::max(registration->uncertainty_m, kLeastUncertainty_m);
  take_box(scene, surface, limits);
  refuse_broken(scene, limits);
  return limits;
}

HeightOverTissue height_over(const Scene& scene, const Surface& surface) {
  const Eigen::Isometry3d to_tissue = Eigen::Isometry3d(robot_of(scene).from_tissue).inverse();
  return [surface, to_tissue](const Vec3& place) {
    const Vec3 here = to_tissue * place;
    const SurfacePoint closest = surface.project(here);
    const Vec3 away = here - surface.position(closest);
    return away.dot(surface.normal(closest)) < 0.0 ? -away.norm() : away.norm();
  };
}

}  // namespace palpation::tool
