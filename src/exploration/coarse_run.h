/// Plans on a coarse mesh, touches on the fine one: what a batch is chosen by need not be known at
/// every vertex of the tissue, what is concluded in the end does.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "geometry/coarsen.h"
#include "palpation/exploration/exploration.h"

namespace palpation {

/// The whole loop, as `run` has it: `planner` explores coarse.mesh, the stops are the same vertices
/// of `surface`, and so are the ways between them. `after_batch` is called after every record, with
/// what was felt on `surface`. Returns all of that, in order. Throws InvalidInput unless the
/// planner's surface has the vertices that `coarse` names.
std::vector<Palpation> run_coarsely(Exploration& planner, const CoarseMesh& coarse,
                                    const Surface& surface, const Probe& probe,
                                    const std::function<void(const Tour&)>& after_batch = {},
                                    double way_step_m = 0.0);

/// The same palpations where the planner knows them: at a vertex if they were made at one that both
/// have, else at the closest place.
std::vector<Palpation> as_planned(const Exploration& planner, const CoarseMesh& coarse,
                                  const Surface& surface, std::span<const Palpation> palpations);

/// The vertices of the coarse mesh that are among these of the fine one; both rising.
std::vector<int> on_coarse(const CoarseMesh& coarse, std::span<const int> vertices);

}  // namespace palpation
