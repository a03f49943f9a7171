/// A session on a scene: what it plans by, and what it hands out.
#pragma once

#include <string>

#include "palpation/session/session.h"
#include "scene/tissue.h"

namespace palpation::tool {

/// `version`: of this program. Throws IoError for a scene that has no next plan.
SessionSetup session_setup(const Scene& scene, const Surface& surface, bool anyway);

/// The scene that answers a session's question as the session does, by `palpate plan`: with what a
/// person asked for.
Scene scene_asked(const Scene& scene, const SessionQuestion& question);

/// The same for a file that may lie anywhere: the mesh by its whole path.
std::string scene_document(const Scene& scene);

}  // namespace palpation::tool
