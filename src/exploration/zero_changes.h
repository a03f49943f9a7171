/// A sensor's zero that moved while one touched.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "palpation/belief/belief.h"
#include "palpation/certainty/misfit.h"

namespace palpation {

/// The changes that readings show by a field which is believed in them anew after each: a reading
/// is then field + offset + noise, the offset normal, its standard deviation the field's, from some
/// reading on. A change is weighed as a misfit is (misfit.h), by the mean over all moments; against
/// the same step made by the tissue itself, on the ground where those since then were made, which a
/// raster cannot tell from it; and passes where tissue that moved, or a gain, explains less
/// (changed_since). `palpations`: as they were
/// made; `believe`: the belief of some. Nothing where readings have no noise, or a slope is
/// modelled, which trades with a step.
std::vector<Misfit> zero_changes(std::span<const Palpation> palpations,
                                 const std::function<Belief(std::vector<Palpation>)>& believe,
                                 const Belief& first);

/// The step of the zero that such readings show whether or not tissue itself may have made it, the
/// ground being another since then; what it adds is estimated. Nothing where zero_changes has none.
std::optional<Misfit> zero_or_tissue(std::span<const Palpation> palpations, const Belief& belief);

/// What the zero of each session differs by from that of those before it, at first sight; nothing
/// where there is one session.
std::vector<Misfit> session_zeros(const Surface& surface, std::span<const Palpation> palpations);
/// The same by a field, and how sure that is. `palpations`: as they were made.
std::vector<Misfit> estimated_zeros(std::span<const Palpation> palpations, const Belief& belief,
                                    std::vector<Misfit> changes);

}  // namespace palpation
