// What was not found, and how large it would have had to be to be found.
#include <numeric>

#include "exploration/search_goal.h"
#include "readings/readings.h"
#include "scene/episode.h"

namespace palpation::tool {
namespace {

constexpr std::size_t kMostTouchesCounted = 1000;

}  // namespace

std::vector<double> readings_that_count(const Exploration& exploration) {
  return used_readings(exploration.conclusion().belief.detrended_palpations());
}

double scatter(const Exploration& exploration) { return scatter_of(exploration.conclusion()); }

std::optional<double> diameter_ruled_out_m(const Episode& episode) {
  return palpation::diameter_ruled_out_m(episode.conclusion(), episode.band_probability());
}

std::optional<GoalState> goal_state(const Episode& episode) {
  const Exploration& exploration = episode.exploration;
  const Aim& aim = exploration.plan().aim;
  if (!aim.has_goal()) return std::nullopt;
  const Conclusion& conclusion = episode.conclusion();
  std::vector<int> all(static_cast<std::size_t>(exploration.surface().vertex_count()));
  std::iota(all.begin(), all.end(), 0);
  return GoalState{
      .diameter_m = aim.undetected_diameter_m,
      .probability = aim.probability,
      .undetected_m = palpation::diameter_ruled_out_m(conclusion, aim.probability),
      .touches_needed = stops_to_goal(conclusion, aim, all, kMostTouchesCounted).size()};
}

}  // namespace palpation::tool
