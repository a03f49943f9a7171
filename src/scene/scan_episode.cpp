// The classical scans, which plan nothing.
#include <algorithm>

#include "palpation/base/error.h"
#include "palpation/decision/baseline.h"
#include "scene/episode_steps.h"
#include "scene/setup.h"

namespace palpation::tool {
namespace {

/// The places of a whole raster, or of the first stage of a refinement, if they can be modelled.
template <typename Make>
auto planned_scan(const Scene& scene, const Make& make) {
  try {
    return make();
  } catch (const InvalidInput&) {
    scene.refuse_value("plan.row_spacing_mm",
                       "coarser: with it the scan comes to more places than can be modelled");
  }
}

void check_count(const Scene& scene, const Exploration& exploration, std::size_t more) {
  const std::size_t count =
      static_cast<std::size_t>(exploration.conclusion().belief.site_count()) + more;
  if (count > static_cast<std::size_t>(kMostPlaces))
    scene.refuse_value("plan.row_spacing_mm", "coarser: with it the scan comes to " +
                                                  std::to_string(count) + " places, and " +
                                                  std::to_string(kMostPlaces) + " can be modelled");
}

/// Touches places in the given order, as a classical scan does, and takes up what was felt.
void scan(Episode& episode, std::span<const SurfacePoint> places, const Probe& probe,
          std::vector<Palpation>& felt) {
  Vec3 previous = Vec3::Zero();
  std::vector<Palpation> fresh;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec3 here = episode.exploration.surface().position(places[i]);
    const Vec3 step = i == 0 ? Vec3(Vec3::Zero()) : Vec3(here - previous);
    episode.course.length_m += step.norm();
    const Vec3 heading = step.norm() > 0.0 ? step.normalized() : Vec3(Vec3::Zero());
    const std::optional<Palpation> palpation = probe(places[i], heading);
    fresh.push_back(palpation ? *palpation : missed_at(places[i]));
    if (palpation && palpation->travel.isZero(0.0)) fresh.back().travel = heading;
    previous = here;
  }
  std::ranges::copy_if(fresh, std::back_inserter(felt),
                       [](const Palpation& one) { return one.kind != TouchKind::Missed; });
  episode.exploration.take_up(fresh);
}

}  // namespace

Episode run_scan(const Scene& scene, const Surface& surface, const World& world,
                 const AfterBatch& after_batch) {
  Plan nothing = plan_of(scene);
  nothing.initial.count = 0;
  nothing.batches = 0;
  Episode episode = started(scene, surface, world, nothing);
  const double spacing = scene.metres("plan.row_spacing_mm");
  std::vector<Palpation> felt;
  const auto finish_stage = [&](BatchStopwatch stopwatch) {
    restate(episode);
    episode.seconds.end_batch(stopwatch);
    if (after_batch) after_batch(episode);
  };
  if (scene.word("plan.acquisition") == "raster") {
    const BatchStopwatch stopwatch;
    const auto places =
        planned_scan(scene, [&] { return raster_scan(surface, spacing, kWayStep_m); });
    check_count(scene, episode.exploration, places.size());
    scan(episode, places, world.probe, felt);
    finish_stage(stopwatch);
    return episode;
  }
  RecursiveRefinement refinement = planned_scan(
      scene, [&] { return RecursiveRefinement(surface, 4.0 * spacing, 0.25 * spacing); });
  for (auto places = refinement.next(0.0); !places.empty();) {
    const BatchStopwatch stopwatch;
    check_count(scene, episode.exploration, places.size());
    const std::size_t before = felt.size();
    scan(episode, places, world.probe, felt);
    refinement.record(std::span(felt).subspan(before));
    finish_stage(stopwatch);
    const std::optional<Level> level = level_in_readings(episode.conclusion());
    places = refinement.next(level ? level->value : 0.0);
  }
  return episode;
}

}  // namespace palpation::tool
