/// Readings that slope over the tissue: because it is thinner on one side, stiffer, or because the
/// arm is not held upright.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "palpation/certainty/edge_belief.h"
#include "palpation/certainty/misfit.h"

namespace palpation {

/// Nats by which a slope must make so many readings more probable: more than chance does, and the
/// freedom to choose it (Schwarz's, of two numbers).
double tilt_price(Eigen::Index readings);

/// Slopes that tissue may have: that of a plane through all readings, which is robust, and those of
/// two plateaus that slope alike (parallel_planes.h). None for fewer than fifteen readings, or
/// where two level plateaus are as probable.
std::vector<Misfit> tilts_of_planes(const Surface& surface, std::span<const Palpation> palpations);

/// The slope of what an edge leaves of the readings, where that explains more of it than chance.
std::optional<Misfit> tilt_left(const Surface& surface, const EdgeBelief& edge,
                                std::span<const Palpation> palpations);

/// Both: what one of them leaves is the other.
Misfit tilt_together(Misfit one, const Misfit& other);

}  // namespace palpation
