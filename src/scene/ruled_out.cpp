// What was not found, and how large it would have had to be to be found.
#include <cmath>
#include <numbers>
#include <numeric>

#include "exploration/search_goal.h"
#include "readings/readings.h"
#include "scene/episode.h"

namespace palpation::tool {
namespace {

/// Nothing that is as large as the tissue needs to be ruled out.
std::optional<double> ruled_out_m(const Episode& episode, double probability) {
  const std::optional<double> diameter_m = diameter_ruled_out_m(episode.conclusion(), probability);
  const double disk_m2 = 0.25 * std::numbers::pi * std::pow(diameter_m.value_or(0.0), 2);
  return disk_m2 < episode.exploration.surface().area() ? diameter_m : std::nullopt;
}

}  // namespace

std::vector<double> readings_that_count(const Exploration& exploration) {
  return used_readings(exploration.conclusion().belief.detrended_palpations());
}

double scatter(const Exploration& exploration) { return scatter_of(exploration.conclusion()); }

std::optional<double> diameter_ruled_out_m(const Episode& episode) {
  return ruled_out_m(episode, episode.band_probability());
}

bool GoalState::is_reached() const {
  return undetected_m && *undetected_m <= diameter_m + 2.0 * kRadiusResolution_m;
}

std::optional<GoalState> goal_state(const Episode& episode) {
  const Exploration& exploration = episode.exploration;
  const Aim& aim = exploration.plan().aim;
  if (!aim.has_goal()) return std::nullopt;
  const Conclusion& conclusion = episode.conclusion();
  std::vector<int> reached(static_cast<std::size_t>(exploration.surface().vertex_count()));
  std::iota(reached.begin(), reached.end(), 0);
  if (exploration.reach().vertices) reached = *exploration.reach().vertices;
  return GoalState{
      .diameter_m = aim.undetected_diameter_m,
      .probability = aim.probability,
      .undetected_m = ruled_out_m(episode, aim.probability),
      .touches_needed = stops_to_goal(conclusion, aim, reached, kMostTouchesCounted).size()};
}

}  // namespace palpation::tool
