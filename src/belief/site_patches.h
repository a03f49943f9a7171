/// Which sites lie near each other, by a linear search.
#pragma once

#include <vector>

#include "palpation/base/types.h"

namespace palpation {

/// The `count` sites nearest to a place, the nearest first; all where there are fewer.
std::vector<int> nearest_to(const Points& sites, const Vec3& place, int count);

/// Patches of neighbours about centres far from each other: dense enough to tell noise from waves,
/// and across enough to tell long ones. All sites where they are no more than some hundred.
std::vector<int> patches_of(const Points& sites);

}  // namespace palpation
