/// Touches that lost contact: far below all others, here and there.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "palpation/readings/palpation.h"

namespace palpation {

/// In each session, whose zero and gain may be its own, the lowest readings, as many as may be but
/// a quarter of all at most, where the gap between them and the others is wider than the others
/// span, the highest twentieth apart, and the places of at least half of them are contradicted: of
/// the four readings nearest to such a place at least two are others, and lie as near to it as such
/// do to each other, the farthest twentieth apart. What lies low in one piece is tissue, which a
/// tumour that fills most of it leaves; and so is what was touched here and there, where most
/// touches are on a lump. `places`: of the palpations. Numbers of palpations, rising; none of a
/// session of fewer than ten readings.
std::vector<std::size_t> lost_contact(std::span<const Palpation> palpations,
                                      std::span<const Vec3> places);

}  // namespace palpation
