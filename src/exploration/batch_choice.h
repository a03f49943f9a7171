/// The stops of one batch, before they are put in order.
#pragma once

#include <span>
#include <vector>

#include "palpation/exploration/choice.h"

namespace palpation {

/// Until contrast is seen, a learned field is not to be believed: spread the touches by the
/// variance of a field of the prior's length instead.
Acquisition acquisition_in_force(const Conclusion& conclusion, const Plan& plan);

/// Among the candidates, rising: while no contrast is seen spread over the tissue, with a second
/// look where readings were high; then first what tells the most about the boundary, and what the
/// acquisition finds best once those are touched; among what searches, a second look where
/// readings are high though they do not surprise. `done`: batches of the plan before this one.
/// `options`: of the plan, from where the probe is.
std::vector<int> chosen_stops(const Conclusion& conclusion, const Plan& plan, int done,
                              std::span<const int> candidates, const BatchOptions& options);

}  // namespace palpation
