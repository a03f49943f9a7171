/// Worlds to be tried on: tissue, tumours and sensors as nobody has tuned a method to, by families.
///
///     Random random(seed);
///     const DrawnWorld world = draw_world("crescent", random, {.size_m = Vec2(0.025, 0.050)});
///     const Phantom phantom(tissue, world.design);
///     FaultySensor sensor(world.faults, world.change, model.low, model.high);
///
/// Outlines lie in a plane of constant z.
#pragma once

#include <span>
#include <string>

#include "palpation/world/phantom.h"
#include "palpation/world/sensor.h"

namespace palpation {

struct WorldFamily {
  std::string name;
  std::string kind;   ///< shape, parts, profile, background, sensor, healthy
  std::string words;  ///< what lies there, a line
};

/// All of them, by kind.
std::span<const WorldFamily> world_families();

/// Where the tissue lies.
struct WorldArea {
  Vec2 size_m = Vec2(0.025, 0.050);  ///< along x and y ...
  Vec3 corner_m = Vec3::Zero();      ///< ... from here
};

struct DrawnWorld {
  PhantomDesign design{};
  SensorFaults faults{};
  SensorChange change{};
};

/// The same stream draws the same world. Of the model the slope is drawn, too, from 500 to 2,000
/// per metre. Throws InvalidInput for a name that is none, and for tissue too small for it: 20 mm
/// each way are enough for all.
DrawnWorld draw_world(const std::string& family, Random& random, const WorldArea& area = {},
                      const StiffnessModel& model = {});

}  // namespace palpation
