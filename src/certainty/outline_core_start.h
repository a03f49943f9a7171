/// Whether an outline of two heights explains the readings, where one of one height does so by
/// fingers.
#pragma once

#include <cstdint>

#include "certainty/outline_draws.h"

namespace palpation {

/// For each chain an outline with a core in place of this one, where that makes the readings more
/// probable by more than chance and what its freedom costs, asked once chains from both have
/// settled a little; one of either kind where readings do not tell, also if they pay for no core
/// while the two end elsewhere; else this one. Such outlines start half way up to what may lie
/// beside a core, from levels of the field, `mean` at the vertices.
ChainStarts with_core_if_paid(const OutlineStart& plain, const Surface& surface, const Field& mean,
                              std::uint64_t seed);

}  // namespace palpation
