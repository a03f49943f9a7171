/// Between which values colours run.
#pragma once

#include <optional>
#include <vector>

namespace palpation::results {

struct Limits {
  double lowest = 0.0, highest = 1.0;
};

/// One reading far from all others must not flatten the map of the rest: two percent of the tissue
/// at either end may lie beyond, which is about as much as one reading moves.
inline constexpr double kBeyondShare = 0.02;

/// Of a mean: as far below the level as above it. Without a level about the middle, and no narrower
/// than noise of that standard deviation makes it: its ripples must not look like a tumour.
Limits limits_of_mean(const std::vector<double>& mean, std::optional<double> level,
                      double noise_sd);

/// Of what begins at nothing, such as a standard deviation.
Limits limits_from_zero(const std::vector<double>& values);

}  // namespace palpation::results
