#include "palpation/certainty/level_estimate.h"

#include "palpation/base/error.h"

namespace palpation {

Level level_from_range(const Marginals& marginals, double fraction) {
  require(fraction > 0.0 && fraction < 1.0, "level_from_range", "fraction = " + text_of(fraction),
          "must lie in (0, 1)");
  require(marginals.mean.size() > 0, "level_from_range", "a field without vertices",
          "has no range");
  const double least = marginals.mean.minCoeff();
  return {least + fraction * (marginals.mean.maxCoeff() - least), std::nullopt};
}

}  // namespace palpation
