/// Metres to and from the unit of a file, in a way that reading back what was written gives the
/// same doubles where there are such.
#pragma once

#include <cmath>

#include "palpation/io/coordinates.h"

namespace palpation {

inline double units_per_metre(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::Millimetre:
      return 1000.0;
    case LengthUnit::Centimetre:
      return 100.0;
    case LengthUnit::Metre:
      return 1.0;
  }
  return 1.0;
}

inline const char* name_of(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::Millimetre:
      return "mm";
    case LengthUnit::Centimetre:
      return "cm";
    case LengthUnit::Metre:
      return "m";
  }
  return "m";
}

/// Division by 1000 rounds once; multiplication by 0.001, which is no double, would round twice.
inline double to_metres(double value, LengthUnit unit) { return value / units_per_metre(unit); }

/// A value that to_metres takes back to value_m: a neighbour of the product, if not the product
/// itself. A few doubles in a hundred have none; they come back within one unit in the last place.
inline double from_metres(double value_m, LengthUnit unit) {
  const double product = value_m * units_per_metre(unit);
  for (const double candidate :
       {product, std::nextafter(product, -HUGE_VAL), std::nextafter(product, HUGE_VAL)}) {
    if (to_metres(candidate, unit) == value_m) return candidate;
  }
  return product;
}

}  // namespace palpation
