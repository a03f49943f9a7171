/// Readings that come late. A probe that slides is filtered, drags the tissue along and meets an
/// edge with its flank: what it says at a place it felt a little before. With the lag l, a reading
/// made at x while travelling along the unit vector t belongs to
///
///     x - l t,
///
/// taken to the closest point of the surface. Readings without a direction of travel stay where
/// they are.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "palpation/belief/belief.h"
#include "palpation/belief/hyperparameters.h"

namespace palpation {

/// The lag before any reading: N(mean, sd^2), and where it is looked for. Sliding probes read on or
/// a little behind where they are; ahead only by what a pose that comes late can explain.
struct LagPrior {
  double mean_m = 0.0005;
  double sd_m = 0.0015;
  double least_m = -0.0005;
  double most_m = 0.003;
};

/// The readings at the places where they belong. One that belongs beyond the tissue's border by
/// more than half a millimetre is set aside: on the border it would be where it never was. Throws
/// InvalidInput unless the lag is finite; with lag 0 nothing changes, bit for bit.
std::vector<Palpation> displaced(const Surface& surface, std::span<const Palpation> palpations,
                                 double lag_m);

struct Lag {
  double value_m = 0.0;
  double stddev_m = 0.0;  ///< the larger of what the curvature at the most probable value says, and
                          ///< of what it moves without a tenth of the readings; the prior's at most
  bool at_bound = false;  ///< the most probable value is the least or the most that was looked at:
                          ///< the readings do not tell the lag
  double log_gain = 0.0;  ///< nats: how much more probable than no lag
};

/// The most probable lag of the readings, raw as they were made, under a field of the given
/// hyperparameters: the marginal likelihood of the displaced readings times the prior, on a grid of
/// a quarter of a millimetre, then refined. Readings that some lag would displace beyond the border
/// do not count; of more than 400 every so many does; where all travel runs along one line, only
/// those at the edges do, because there drift looks like a lag elsewhere. Nothing where no reading
/// that counts has a direction of travel, or there are fewer than two.
std::optional<Lag> learn_lag(const Prior& prior, std::span<const Palpation> palpations,
                             const Hyperparameters& at, const LagPrior& lag_prior = {});

}  // namespace palpation
