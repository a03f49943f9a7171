/// What is believed after an episode, as it is shown: the same for the files of a run and for those
/// who look on while it goes.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "palpation/io/write_vtp.h"
#include "results/run.h"
#include "scene/episode.h"
#include "scene/tissue.h"

namespace palpation::tool {

using NamedFields = std::vector<std::pair<std::string, Field>>;

/// At the vertices, by the names that they have in surface.vtp. `world`: what is true, or null.
NamedFields believed_fields(const Episode& episode, const World* world);

/// The boundary, its band and the cut line, as boundary.vtp has them; of a world its truth.
std::vector<BoundaryCurve> believed_curves(const Scene& scene, const Episode& episode,
                                           const World* world);

/// The run that `palpate boundary` would have written on these measurements, without its folder.
/// `warnings`: of what was given.
results::Run believed_run(const Scene& scene, const Tissue& tissue, const Episode& episode,
                          const std::vector<std::string>& warnings);

}  // namespace palpation::tool
