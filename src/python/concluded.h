/// A conclusion as Python holds it.
#pragma once

#include <utility>

#include "palpation/exploration/conclusion.h"

namespace palpation::python {

/// With what arrays are views of.
struct Concluded {
  Concluded(Surface tissue, Conclusion all)
      : surface(std::move(tissue)), conclusion(std::move(all)) {
    const ReadingScale scale = conclusion.scale();
    const Field& modelled = conclusion.marginals.mean;
    mean = modelled.unaryExpr([scale](double value) { return as_reading(scale, value); });
    stddev = conclusion.marginals.variance.cwiseSqrt().binaryExpr(
        modelled, [scale](double sd, double at) { return sd * reading_per_step(scale, at); });
    if (conclusion.certainty) probability_inside = conclusion.certainty->probability_inside();
  }

  Surface surface;
  Conclusion conclusion;
  Field mean, stddev;          ///< in the readings' unit
  Field probability_inside{};  ///< empty while there is no level
};

}  // namespace palpation::python
