/// Readings by the passes in which they were made: one way along the tissue, without a jump.
#pragma once

#include <cstddef>
#include <vector>

#include "palpation/base/types.h"

namespace palpation {

/// Numbers of readings, rising by one.
using Pass = std::vector<std::size_t>;

/// In order, every reading in one of them. A pass ends where the next reading lies more than 5 mm
/// away (another row, another stop), or where the probe turns: falls back by 1.5 mm, or leaves its
/// line by as much.
std::vector<Pass> passes_of(const std::vector<Vec3>& places);

double median_step_m(const std::vector<Vec3>& places, const Pass& pass);

}  // namespace palpation
