#include "scene/episode_steps.h"

#include <algorithm>
#include <utility>

#include "scene/setup.h"

namespace palpation::tool {
namespace {

RegionError error_of(const Episode& episode) {
  const Exploration& exploration = episode.exploration;
  if (!episode.plain_truth || !exploration.conclusion().level)
    return compare(exploration.surface(), episode.estimate, *episode.truth);
  const Contour& contour = *exploration.conclusion().contour;
  return compare(exploration.surface(), Superlevel{contour.field, contour.level},
                 *episode.plain_truth);
}

}  // namespace

Reach within_reach(const Scene& scene, const Surface& surface, Reach reach) {
  const std::optional<std::vector<int>> reached = reachable_of(scene, surface);
  if (!reached) return reach;
  std::vector<int> vertices = reach.vertices.value_or(*reached);
  std::erase_if(vertices,
                [&](int vertex) { return !std::ranges::binary_search(*reached, vertex); });
  if (vertices.empty()) scene.refuse("robot", "reaches no tissue that can be felt");
  reach.vertices = std::move(vertices);
  return reach;
}

Episode started(const Scene& scene, const Surface& surface, Plan plan, Reach given_reach) {
  Reach reach = within_reach(scene, surface, std::move(given_reach));
  return Episode{.exploration = Exploration(surface, model_of(scene), std::move(plan),
                                            std::move(reach), outlines_seed_of(scene)),
                 .cut_risk = scene.number("band.cut_risk")};
}

Episode started(const Scene& scene, const Surface& surface, const World& world, Plan plan) {
  const Stopwatch starting;
  Episode episode = started(scene, surface, std::move(plan), world.reach);
  episode.truth = superlevel_region(surface, world.truth, world.true_level);
  episode.truth_is = world.truth_is;
  if (scene.word("error.arithmetic") == "plain")
    episode.plain_truth = Superlevel{world.truth, world.true_level};
  episode.seconds.start = starting.seconds();
  return episode;
}

void restate(Episode& episode) {
  const Exploration& exploration = episode.exploration;
  TraceRow row;
  row.batch = exploration.batch() - 1;
  row.measurements = static_cast<int>(exploration.conclusion().palpations.size());
  row.path_m = episode.course.length_m;
  if (exploration.conclusion().belief.site_count() > 0) {
    episode.estimate = Region();
    if (exploration.conclusion().level) {
      row.level = level_in_readings(exploration.conclusion())->value;
      const std::optional<Certainty>& certainty = exploration.conclusion().certainty;
      if (certainty && !exploration.conclusion().tip_hides_all())
        row.expected_error_m2 = certainty->expected.symmetric_difference_m2();
      const Contour& contour = *exploration.conclusion().contour;
      episode.estimate = superlevel_region(exploration.surface(), contour.field, contour.level);
    }
    if (episode.truth) episode.error = error_of(episode);
    row.error = episode.error;
  }
  episode.trace.push_back(row);
}

}  // namespace palpation::tool
