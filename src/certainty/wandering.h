/// Places that wander: tissue that breathes or sags, an arm whose calibration drifts. Each reading
/// was made elsewhere than it is said to be, by a way of its own, and by one that lasts over some
/// readings, in the order in which they were made.
///
/// To first order nothing of that shows: an edge is no wider than tissue breathes, and an outline
/// follows its readings. So ways are drawn with outlines, and how far places wander is among the
/// unknown, down to nothing that matters: short walks tell whether it is more. In another order
/// readings tell of other ways.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "certainty/outline_start.h"
#include "certainty/outline_walk.h"

namespace palpation {

/// Of readings that were made in this order.
ReadingWays ways_of(std::span<const std::vector<Made>> made);

/// From here on places wander by these ways; how far is learned.
void let_wander(const ReadingWays& ways, OutlineStart& start);

/// Whether one of two walks from there is sure that they do, by more than can matter: it costs
/// little to draw ways that are none.
bool do_places_wander(const OutlineStart& wandering, std::uint64_t seed);

/// By draws in which they do.
WanderingPlaces wandering_by(const std::vector<OutlineDraw>& draws,
                             const OutlineReadings& readings);

}  // namespace palpation
