/// Readings that slope over the tissue: because it is thinner on one side, stiffer, or because the
/// arm is not held upright.
#pragma once

#include <optional>
#include <span>

#include "palpation/certainty/edge_belief.h"
#include "palpation/certainty/misfit.h"

namespace palpation {

/// Whether a plane explains so much of the readings that one must ask whether tissue slopes: a
/// tumour on one side looks alike.
bool may_be_tilted(const Surface& surface, std::span<const Palpation> palpations);

/// The slope that a field with one has found, as what it adds to the readings.
Misfit tilt_of(const Belief& sloped);

/// The slope of what an edge leaves of the readings, where that explains more of it than chance.
std::optional<Misfit> tilt_left(const Surface& surface, const EdgeBelief& edge,
                                std::span<const Palpation> palpations);

/// Both: what one of them leaves is the other.
Misfit tilt_together(Misfit one, const Misfit& other);

/// Of the readings as a plane and noise of which nothing is known, as EdgeBelief::log_evidence is:
/// without what depends on their number alone, less Schwarz's price of a constant.
double log_evidence_of_plane(const Belief& sloped);

}  // namespace palpation
