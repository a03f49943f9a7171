/// How probable outlines make readings.
#pragma once

#include <cstddef>
#include <optional>

#include "palpation/certainty/outline_posterior.h"

namespace palpation {

struct OutlineEvidence {
  double log_density = 0.0;  ///< of the readings, less what their freedom costs, nats
  std::size_t readings = 0;  ///< that outlines are drawn by
};

/// By outlines of one height about the edge, once walks have settled: compares with that of the
/// same readings in another unit. Nothing where there is no outline. Takes a third of a second.
std::optional<OutlineEvidence> outline_evidence(const Belief& belief, const EdgeBelief& edge,
                                                const OutlineOptions& options);

}  // namespace palpation
