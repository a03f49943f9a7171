/// From a scene to the objects of the library.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "palpation/exploration/exploration.h"
#include "palpation/exploration/reach.h"
#include "palpation/exploration/waypoint.h"
#include "palpation/geometry/surface.h"
#include "palpation/world/catalogue.h"
#include "palpation/world/phantom.h"
#include "scene/bound_keys.h"
#include "scene/scene.h"

namespace palpation::tool {

FieldModel field_of(const Scene& scene);
Model model_of(const Scene& scene);
Plan plan_of(const Scene& scene);
/// Of the outlines that are drawn; nothing where Laplace's approximation is asked for.
std::optional<std::uint64_t> outlines_seed_of(const Scene& scene);
Robot robot_of(const Scene& scene);
/// All keys with their values, and where the tissue is, which a file that the scene names may say.
nlohmann::json options_in_force(const Scene& scene);
/// What the robot can touch, in the tissue's frame; where to keep out is not its own.
Access access_of(const Scene& scene);
/// Whether that is limited, by the robot or by where to keep out.
bool limits_reach(const Scene& scene);
/// The vertices that can be touched, where it is.
std::optional<std::vector<int>> reachable_of(const Scene& scene, const Surface& surface);
/// What the scene's simulated probe touches.
DrawnWorld world_of(const Scene& scene, const Surface& surface);
Phantom phantom_of(const Scene& scene, const Surface& surface, const PhantomDesign& design);

}  // namespace palpation::tool
