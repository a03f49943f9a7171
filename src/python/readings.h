/// What was felt, and where, as Python holds it.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "palpation/geometry/surface.h"
#include "palpation/readings/palpation.h"

namespace palpation::python {

struct Readings {
  Surface surface;
  std::vector<Palpation> palpations;
};

/// What is given of several readings beside their places.
struct Felt {
  pybind11::object values;          ///< n numbers; NaN: could not be touched
  pybind11::object noise_variance;  ///< None, a number, or n numbers; NaN: the field's noise
  pybind11::object travel;          ///< None, or n x 3: unit directions, or zeros
};

/// One palpation a place. Throws as arrays.h says, and InvalidInput unless readings are at most
/// 1e30 in size, variances 0 or from 1e-60 to 1e60, directions zero or of some length.
std::vector<Palpation> palpations_of(const std::vector<SurfacePoint>& places, const Felt& felt,
                                     const char* function);

/// Throws InvalidInput unless it is the same surface, or one with the same triangles.
void require_same_surface(const Surface& surface, const Surface& other, const char* function);

}  // namespace palpation::python
