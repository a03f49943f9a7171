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

/// Whether a change adds the same to all readings since; what a session's gain would add, its zero
/// does.
bool moves_zero(const Misfit& change);

/// Makes it start with this outline: its loops, its parts, and what of the prior is about them.
void begin_with(const OutlineNodes& outline, OutlineStart& start);

/// Nothing where there is no boundary. The readings are sorted, so that their order tells nothing.
/// `mean`: the belief's at the vertices, without a trend. `profile_error`: as ShapePrior has it; no
/// noise is less.
std::optional<OutlineStart> outline_start(const Belief& belief, const Field& mean,
                                          const EdgeBelief& edge, const OutlineOptions& options,
                                          double profile_error = ShapePrior{}.profile_error);

}  // namespace palpation
