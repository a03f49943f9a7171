/// Readings below those of healthy tissue: contact that was lost for a while, a vessel, a cyst.
#pragma once

#include <vector>

#include "exploration/as_if_unchanged.h"

namespace palpation {

/// Whether nine in ten of the readings that count, or more, lie inside of the edge: tissue that is
/// stiff but for a patch is healthy, with a soft spot.
bool is_all_but_a_patch(const Known& known);

/// What readings say as if nothing had changed (known_as_if_unchanged). Where they make a tumour of
/// all but a spot, the spot is set aside in `felt` (kSoftSpot): it is soft, and the rest healthy
/// but for what shows an edge of its own. That nearly all of some tissue is tumour is less probable
/// than a cyst, a vessel or contact that was lost for a while.
Known known_beside_soft_spot(const Surface& surface, const Model& model,
                             std::vector<Palpation>& felt, ConclusionCache& cache, bool is_last);

}  // namespace palpation
