/// What values alone tell of a contrast where a sensor counts in steps.
#pragma once

#include <span>

namespace palpation {

/// By how much any law makes readings more probable than one normal law that is rounded as they
/// are does, nats: what values alone may tell of two plateaus, at most. Two neighbouring values are
/// no plateaus but what rounding makes of noise. Infinity where readings have no step.
double most_evidence_if_rounded(std::span<const double> readings);

}  // namespace palpation
