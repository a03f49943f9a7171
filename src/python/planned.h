/// A plan as Python gives it.
#pragma once

#include <pybind11/pybind11.h>

#include "palpation/exploration/plan.h"

namespace palpation::python {

struct Planned {
  Plan plan;
  pybind11::dict values;  ///< as it was given, for those who look at it
};

}  // namespace palpation::python
