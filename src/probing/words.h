/// Lengths in words.
#pragma once

#include <cmath>
#include <string>

#include "palpation/base/error.h"

namespace palpation {

/// To a micrometre: "1.235 mm".
inline std::string in_mm(double length_m) {
  return text_of(std::round(length_m * 1e6) / 1e3) + " mm";
}

}  // namespace palpation
