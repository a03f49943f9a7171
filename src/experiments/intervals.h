/// How sure a figure of an experiment is, from its trials.
#pragma once

#include <optional>
#include <span>

namespace palpation::tool {

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// Of a probability, `hits` of `trials`: Wilson's score interval (Wilson 1927), which holds its
/// level near 0 and 1 and for few trials. Throws InvalidInput unless 0 <= hits <= trials, trials >
/// 0 and confidence in (0, 1).
Interval wilson_interval(int hits, int trials, double confidence = 0.95);

/// Of a mean, by Student's t; nothing of fewer than two values.
std::optional<Interval> mean_interval(std::span<const double> values, double confidence = 0.95);

}  // namespace palpation::tool
