/// What of the tissue no reading that counts is near.
#pragma once

#include "draw/outcome.h"

namespace palpation::draw {

/// Gives the surface the field kBeyondSearch (results/parts.h), by the touches that are made and
/// count.
void add_beyond_search(Outcome& outcome);

}  // namespace palpation::draw
