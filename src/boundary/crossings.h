/// How tangled rings are, before an overlay is paid for. Private to this folder.
#pragma once

#include <span>

#include "boundary/exact_polygons.h"

namespace palpation {

/// Whether the rings' edges surely cross, run along each other or crowd at one point no more than
/// `limit` times (to rounding; equal edges count as one). Time and memory stay bounded: rings that
/// would take too long to count are not sure.
bool cross_at_most(long limit, std::span<const ExactRing* const> rings);

}  // namespace palpation
