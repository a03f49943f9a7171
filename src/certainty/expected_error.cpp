#include "palpation/certainty/expected_error.h"

#include <cmath>

namespace palpation {

Field probability_inside(const Marginals& marginals, const Level& level) {
  const double level_variance = level.stddev.value_or(0.0) * level.stddev.value_or(0.0);
  Field probability(marginals.mean.size());
  for (Eigen::Index vertex = 0; vertex < probability.size(); ++vertex) {
    const double distance = marginals.mean[vertex] - level.value;
    const double variance = marginals.variance[vertex] + level_variance;
    probability[vertex] = variance > 0.0 ? 0.5 * std::erfc(-distance / std::sqrt(2.0 * variance))
                                         : (distance >= 0.0 ? 1.0 : 0.0);
  }
  return probability;
}

ExpectedError expected_error(const Surface& surface, const Marginals& marginals,
                             const Level& level) {
  const Field inside = probability_inside(marginals, level);
  ExpectedError error;
  for (Eigen::Index vertex = 0; vertex < inside.size(); ++vertex) {
    const double area = surface.vertex_areas()[vertex];
    if (marginals.mean[vertex] >= level.value) {
      error.extra_m2 += area * (1.0 - inside[vertex]);
    } else {
      error.missed_m2 += area * inside[vertex];
    }
  }
  return error;
}

}  // namespace palpation
