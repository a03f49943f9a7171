/// Loops of a first outline that the readings do not pay for.
///
/// A chain's loops move, but none vanishes; and where noise is strong and was taken for too weak, a
/// first boundary has parts and holes that are noise. They would stay, draw the plateau to the rest
/// and hold the outline too large.
#pragma once

#include <cstdint>

#include "certainty/outline_start.h"

namespace palpation {

/// What the freedom of an outline's loops costs, nats.
double price_of_loops(const OutlineNodes& outline, std::size_t readings);

/// Without loops that make the readings more probable by less than their freedom costs
/// (price_of_loop), asked once a chain from here has settled a little; the largest stays. The holes
/// of a part that goes, go along.
OutlineStart pruned(OutlineStart start, std::uint64_t seed);

}  // namespace palpation
