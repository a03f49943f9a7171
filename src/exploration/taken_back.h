/// What changed while one touched, taken back: readings as if sensor and tissue had stayed.
#pragma once

#include <span>
#include <vector>

#include "palpation/certainty/misfit.h"
#include "palpation/geometry/surface.h"

namespace palpation {

/// Sensors are fastened anew, and tissue slips, so often.
inline constexpr std::size_t kMostChanges = 4;

/// Sets a change of zero or gain that concerns the readings of a session and the later ones, but
/// for one in twenty of all, down as that session's, which is among the changes with its zero.
Misfit as_of_its_session(Misfit change, std::span<const Misfit> changes,
                         std::span<const Palpation> palpations);

/// What a slope or waves add to a reading there.
double added_at(const Surface& surface, const Unevenness& background, const SurfacePoint& where);

/// The readings, those since each change without what it did, one after the other. What was felt
/// where no tissue lay before it moved is set aside (kBeyondTissue).
std::vector<Palpation> with_changes_taken_back(const Surface& surface,
                                               std::vector<Palpation> palpations,
                                               std::span<const Misfit> changes);

}  // namespace palpation
