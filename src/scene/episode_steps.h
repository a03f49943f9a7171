/// What all ways to run a scene have in common: their start, and what follows a batch. Private to
/// this folder.
#pragma once

#include "scene/episode.h"

namespace palpation::tool {

/// What can be touched, of what the robot reaches.
Reach within_reach(const Scene& scene, const Surface& surface, Reach reach);

/// Before any touch: without a truth, or against a world.
Episode started(const Scene& scene, const Surface& surface, Plan plan, Reach given_reach);
Episode started(const Scene& scene, const Surface& surface, const World& world, Plan plan);

/// The estimate and its error as they follow from the exploration's state, and a row of the trace.
void restate(Episode& episode);

/// A classical scan in place of batches: a raster, or a recursive refinement.
Episode run_scan(const Scene& scene, const Surface& surface, const World& world,
                 const AfterBatch& after_batch);

}  // namespace palpation::tool
