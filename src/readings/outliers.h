/// Readings that contradict those around them.
#pragma once

#include <cstddef>
#include <vector>

#include "palpation/readings/palpation.h"

namespace palpation {

/// Numbers of the readings, not set aside, that the nearest twenty others do not allow: each is
/// predicted from those by a rough field (Matern 3/2 of the length), and may deviate by five
/// standard deviations of that prediction, unless more than one in six within that length read more
/// like it. The field's standard deviation is half the range of the others, or of all where the
/// others show no contrast; where the nearest lie within 0.57 of the length, of what was felt
/// twice. Readings made on the way in different directions count as up to 0.86 of it farther apart:
/// a lag may set them so. The worst goes first, and what is left is judged anew. Where more than a
/// tenth would go the field is to blame, and nothing is found.
std::vector<std::size_t> outliers(const std::vector<Palpation>& palpations,
                                  const std::vector<Vec3>& places, double length_m);

}  // namespace palpation
