/// Lengths of a scene that do not fit its tissue.
#pragma once

#include <string>
#include <vector>

#include "palpation/geometry/surface.h"
#include "scene/scene.h"

namespace palpation::tool {

/// A sentence each: a length of the field beyond the tissue's size or below that of its edges,
/// stops that must be farther apart than the tissue is wide. Of what the scene gives, not of
/// defaults.
std::vector<std::string> scale_remarks(const Scene& scene, const Surface& surface);

}  // namespace palpation::tool
