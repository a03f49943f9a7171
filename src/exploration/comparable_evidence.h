/// Evidence of versions of the same readings, of which each may know some together.
///
/// Readings on the way that differ by no more than noise does are one row of the belief, and so are
/// those of one place; which they are depends on the noise that a version has learned, and on where
/// it takes its readings to lie. A row more is a density more, in the reading's unit. What a row
/// holds besides its mean is noise, as probable on the average whatever the version.
#pragma once

#include <optional>
#include <span>

#include "exploration/find_boundary.h"

namespace palpation {

/// That of a version's rows, as if it knew as many as any other: noise of that variance, which all
/// that are compared share, makes each as probable as -1/2 (log variance + 1).
double comparable(double log_evidence, const Belief& belief, double noise_variance);

/// By an edge; no edge is the least that can be.
double comparable_evidence(const std::optional<EdgeBelief>& edge, const Belief& belief,
                           double noise_variance);

/// Of the rows' density over that of the same without a change: without a gain they are so much
/// denser. 0 for other changes.
double log_scale_of(const Misfit& change, const Belief& belief);

}  // namespace palpation
