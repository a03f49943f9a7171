/// The level, read off where it matters: at the edge. Across the tumour's boundary the readings
/// rise from one plateau to another along a sigmoid of their depth (equation (4) of Garg et al.
/// 2016); the level is a fraction of the way between the plateaus.
///
///     reading = low + (high - low) / (1 + exp(-slope (depth + shift))),      h = low + fraction
///     (high - low)
///
/// The greatest and the least of a field's mean chase noise, for an exploration puts few touches on
/// the plateaus; the profile is fitted to all readings at once, and tells how well it knows the
/// level.
#pragma once

#include <optional>
#include <span>

#include "palpation/belief/belief.h"
#include "palpation/belief/level.h"

namespace palpation {

struct EdgeReading {
  double depth_m = 0.0;  ///< distance from the boundary as it is believed, positive inside
  double reading = 0.0;
  double variance = 1.0;  ///< of its noise, reading units squared; positive
};

/// What is known of an edge before any reading. Both priors are wide: tissue is seldom steeper or
/// flatter by more than the factor e, and the boundary that depths are measured from seldom off by
/// more than a millimetre.
struct EdgePrior {
  double slope_per_m = 1200.0;  ///< median
  double slope_log_sd = 0.5;
  double shift_sd_m = 0.0005;
  double plateau = 0.0;     ///< both plateaus are near this value ...
  double plateau_sd = 1.0;  ///< ... to about this much, reading units; positive
};

struct EdgeProfile {
  double low = 0.0;
  double high = 0.0;
  double slope_per_m = 0.0;
  double shift_m = 0.0;  ///< how much deeper than believed each reading lies
  Level level;           ///< with its standard deviation, the misfit of the profile included
};

/// What share of the contrast is felt at a depth as it is believed.
double share_at_depth(const EdgeProfile& profile, double depth_m);

/// The most probable profile (Levenberg and Marquardt), and the level's standard deviation from the
/// curvature there; where readings scatter around the profile more than their variances say, that
/// much greater. At least one reading; without readings on one side that plateau is known from the
/// prior alone, and the level's standard deviation tells. Throws InvalidInput for values that are
/// not finite, variances and prior widths that are not positive, and a fraction outside (0, 1);
/// NumericalError if the profile's parameters are not finite.
EdgeProfile fit_edge(std::span<const EdgeReading> readings, double fraction,
                     const EdgePrior& prior);

/// The level of the belief's readings: depths are measured from the boundary at a first level, the
/// profile fitted, and again from the boundary at its level until that rests (at most eight times).
/// The tissue's border is no edge. Starts from the range of the mean; that is also the answer, with
/// half the range for a standard deviation, where no boundary can be drawn. `marginals`: of the
/// belief, at the vertices. Throws as fit_edge.
Level level_from_edge(const Surface& surface, const Belief& belief, const Marginals& marginals,
                      double fraction);

}  // namespace palpation
