/// Readings that contradict those around them.
#pragma once

#include <cstddef>
#include <vector>

#include "palpation/readings/palpation.h"

namespace palpation {

/// Numbers of the readings, not set aside, that the nearest twenty others made in the same
/// direction of travel do not allow: each is predicted from those by a rough field (Matern 3/2 of
/// the length 3.5 mm, its standard deviation half the range of the others, or of all where the
/// others show no contrast), and may deviate by five standard deviations of that prediction. The
/// worst goes first, and what is left is judged anew. Where more than a tenth would go the field is
/// to blame, and nothing is found.
std::vector<std::size_t> outliers(const std::vector<Palpation>& palpations,
                                  const std::vector<Vec3>& places);

}  // namespace palpation
