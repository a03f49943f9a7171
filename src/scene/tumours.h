/// The tumours of a scene, and what is wrong with them in the scene's own words.
#pragma once

#include <vector>

#include "palpation/base/error.h"
#include "palpation/world/tumour.h"
#include "scene/scene.h"

namespace palpation::tool {

std::vector<Tumour> tumours_of(const Scene& scene);

/// Says which tumour a surface refuses and why, in millimetres and by the scene's keys: throws
/// IoError. Does nothing if it refuses none.
void refuse_tumours(const Scene& scene, const Surface& surface, const std::vector<Tumour>& tumours);

}  // namespace palpation::tool
