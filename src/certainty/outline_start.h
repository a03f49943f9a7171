/// Where the sampling of outlines starts: the readings in the chart's plane, the edge's boundary as
/// nodes, and the prior about its profile.
#pragma once

#include <optional>

#include "certainty/outline_model.h"
#include "palpation/certainty/outline_posterior.h"

namespace palpation {

struct OutlineStart {
  OutlineReadings readings;
  OutlinePrior prior;
  OutlineNodes outline;
  OutlineProfile profile;
};

/// Nothing where there is no boundary. The readings are sorted, so that their order tells nothing.
std::optional<OutlineStart> outline_start(const Belief& belief, const EdgeBelief& edge,
                                          const OutlineOptions& options);

}  // namespace palpation
