/// Results in plain words.
#pragma once

#include <string>
#include <vector>

#include "palpation/exploration/waypoint.h"
#include "scene/episode.h"

namespace palpation::tool {

/// What is said where a trend is modelled and too few places are touched for one.
inline constexpr const char* kTooFewForTrend =
    "No conclusion: fewer than 15 places have been touched, too few to tell a tumour from a tilt.";

/// What was taken out as weaker than plan.min_contrast: where, and by how much it stands out.
std::string weaker_words(const Exploration& exploration);
/// What explains readings without an edge.
std::string instead_of_edge(const EdgeOdds& odds);
/// What is said where no level could be found.
std::string no_level_words(const Exploration& exploration);

/// Below this probability a part is told as one that may not exist.
inline constexpr double kSure = 0.95;

std::string fixed(double value, int digits);
/// "1 reading", "2 readings".
std::string counted(std::size_t count, const std::string& noun);
std::string percent(double probability);
/// Of something: "30 % of", "3.0 times".
std::string share_words(double share);
/// Readings have any unit: three digits behind the point where that says something.
std::string reading_text(double value);
/// "(5.0, 14.0, 0.0) mm".
std::string place_words(const Vec3& place_m, int digits);
/// "7.264 at (5.0, 14.0, 0.0) mm".
inline std::string reading_words(double reading, const Vec3& place_m) {
  return reading_text(reading) + " at " + place_words(place_m, 1);
}
/// The words after this start, where they have it.
std::string without(const std::string& start, const std::string& words);

/// One line on the state after a batch.
std::string batch_words(const Episode& episode);
/// What was touched and found, and how wrong it is where the truth is known.
std::string episode_words(const Episode& episode);
/// Warnings, to the error stream.
void tell(const std::vector<std::string>& warnings);
/// How wrong an estimate is; the sentence starts with what it is compared with.
std::string error_words(const RegionError& error, double search_area_m2,
                        const std::string& against = "Against the truth");
/// What the search was to rule out and has not; empty where it has, or nothing was asked for.
std::string goal_words(const Episode& episode);
/// The next stops; where there are none, why, and what the search has left open.
std::string plan_words(const Episode& episode, const std::vector<Waypoint>& stops, double path_m);

}  // namespace palpation::tool
