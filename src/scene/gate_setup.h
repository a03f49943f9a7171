/// The gate that a scene asks for: its limits, and the tissue in the robot's frame.
#pragma once

#include "palpation/geometry/surface.h"
#include "palpation/robot/gate.h"
#include "scene/scene.h"

namespace palpation::tool {

/// Throws IoError where the scene's robot.limits contradict each other, whatever the tissue.
void check_limits(const Scene& scene);
/// Throws IoError where the scene's robot.limits contradict each other, or the tissue lies farther
/// from the robot's base than any arm reaches: a transform in millimetres.
GateLimits gate_limits_of(const Scene& scene, const Surface& surface);
/// Over the surface where the scene takes it to be.
HeightOverTissue height_over(const Scene& scene, const Surface& surface);

}  // namespace palpation::tool
