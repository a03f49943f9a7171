/// The columns of a measurements file, in the order in which they are written.
#pragma once

#include <array>

namespace palpation {

inline constexpr std::array kMeasurementColumns = {
    "x", "y", "z", "reading", "noise_variance", "batch", "kind", "tx", "ty", "tz", "set_aside"};

}  // namespace palpation
