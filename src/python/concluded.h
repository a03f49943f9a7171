/// A conclusion as Python holds it.
#pragma once

#include <utility>

#include "palpation/exploration/conclusion.h"

namespace palpation::python {

/// With what arrays are views of.
struct Concluded {
  Concluded(Surface tissue, Conclusion all)
      : surface(std::move(tissue)), conclusion(std::move(all)) {
    stddev = conclusion.marginals.variance.cwiseSqrt();
    if (conclusion.certainty) probability_inside = conclusion.certainty->probability_inside();
  }

  Surface surface;
  Conclusion conclusion;
  Field stddev;
  Field probability_inside{};  ///< empty while there is no level
};

}  // namespace palpation::python
