/// How probable outlines make readings.
#pragma once

#include <optional>
#include <vector>

#include "palpation/certainty/outline_posterior.h"

namespace palpation {

struct OutlineEvidence {
  double log_density = 0.0;  ///< of the rows, nats, less what an outline's freedom costs
  std::vector<std::vector<Made>> rows{};  ///< readings that are one, each
};

/// By outlines of one height about the edge, once walks have settled: compares with that of the
/// same readings in another unit. Nothing where there is no outline. Takes some tenths of a second.
/// `profile_error`: as ShapePrior has it; no noise is less.
std::optional<OutlineEvidence> outline_evidence(const Belief& belief, const EdgeBelief& edge,
                                                const OutlineOptions& options,
                                                double profile_error);

}  // namespace palpation
