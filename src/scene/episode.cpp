#include "scene/episode.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "belief/field_not_fitted.h"
#include "exploration/coarse_run.h"
#include "exploration/search_goal.h"
#include "palpation/base/error.h"
#include "palpation/geometry/path.h"
#include "scene/episode_steps.h"
#include "scene/setup.h"

namespace palpation::tool {
namespace {

/// A probe that stops the run before it comes to more places than can be modelled.
class CountingProbe {
 public:
  CountingProbe(const Scene& scene, const Exploration& exploration, const Probe& probe)
      : scene_(scene), exploration_(exploration), probe_(probe) {}

  std::optional<Palpation> operator()(const SurfacePoint& where, const Vec3& travel) {
    if (exploration_.batch() != batch_) felt_ = 0;
    batch_ = exploration_.batch();
    if (exploration_.conclusion().belief.site_count() + ++felt_ > kMostPlaces)
      scene_.refuse("plan", "comes to more than " + std::to_string(kMostPlaces) +
                                " places, which is more than can be modelled: take fewer batches");
    return probe_(where, travel);
  }

 private:
  const Scene& scene_;
  const Exploration& exploration_;
  const Probe& probe_;
  int batch_ = 0;
  int felt_ = 0;  // in this batch
};

double way_step_m(const Scene& scene) {
  return scene.truth("plan.readings_along_path") ? kWayStep_m : 0.0;
}

/// What the coarse mesh can be touched at.
Reach coarse_reach(const Scene& scene, const Surface& surface, const CoarseMesh& coarse,
                   const Reach& given) {
  const Reach fine = within_reach(scene, surface, given);
  Reach reach{.touch_once = fine.touch_once};
  if (!fine.vertices) return reach;
  reach.vertices = on_coarse(coarse, *fine.vertices);
  if (reach.vertices->empty())
    scene.refuse_value("plan.explore_mm",
                       "finer: none of the vertices that are left can be touched");
  return reach;
}

/// What explores the coarse mesh.
Exploration coarse_planner(const Scene& scene, const Surface& surface, const CoarseMesh& coarse,
                           const Reach& reach) {
  const Plan plan = plan_of(scene);
  if (std::max(plan.initial.count, plan.batch.size) > static_cast<int>(coarse.vertices.size()))
    scene.refuse_value("plan.explore_mm", "finer: it leaves " +
                                              std::to_string(coarse.vertices.size()) +
                                              " vertices, fewer than are touched at once");
  return Exploration(Surface(coarse.mesh), model_of(scene), plan,
                     coarse_reach(scene, surface, coarse, reach), outlines_seed_of(scene));
}

/// Plans on a coarse mesh; when all is felt, concludes on the whole one.
Episode run_coarse_exploration(const Scene& scene, const Surface& surface, const World& world,
                               const AfterBatch& after_batch) {
  const Stopwatch starting;
  const CoarseMesh coarse = coarsen(surface, scene.metres("plan.explore_mm"));
  Exploration planner = coarse_planner(scene, surface, coarse, world.reach);
  Plan nothing = plan_of(scene);
  nothing.initial.count = nothing.batches = 0;
  Episode episode = started(scene, surface, world, nothing);
  episode.seconds.start = starting.seconds();
  BatchStopwatch stopwatch;
  std::vector<int> planned = planner.next();
  const auto finish_batch = [&](const Tour& tour) {
    for (int& stop : planned) stop = coarse.vertices[static_cast<std::size_t>(stop)];
    episode.course.add(planned, tour);
    planned = planner.next();
    TraceRow row;
    row.batch = planner.batch() - 1;
    row.measurements = static_cast<int>(planner.conclusion().palpations.size());
    row.path_m = episode.course.length_m;
    if (planner.conclusion().level) row.level = level_in_readings(planner.conclusion())->value;
    if (planner.conclusion().certainty)
      row.expected_error_m2 = planner.conclusion().certainty->expected.symmetric_difference_m2();
    if (!planned.empty()) episode.trace.push_back(row);  // the last one is of the conclusion
    episode.seconds.end_batch(stopwatch);
  };
  episode.exploration.take_up(run_coarsely(planner, coarse, surface,
                                           CountingProbe(scene, planner, world.probe), finish_batch,
                                           way_step_m(scene)));
  episode.coarse_stop_reason = planner.stop_reason();
  restate(episode);
  if (after_batch) after_batch(episode);
  return episode;
}

Episode run_exploration(const Scene& scene, const Surface& surface, const World& world,
                        const AfterBatch& after_batch) {
  Episode episode = started(scene, surface, world, plan_of(scene));
  BatchStopwatch stopwatch;
  std::vector<int> planned = episode.exploration.next();
  const auto finish_batch = [&](const Tour& tour) {
    episode.course.add(planned, tour);
    planned = episode.exploration.next();
    restate(episode);
    episode.seconds.end_batch(stopwatch);
    if (after_batch) after_batch(episode);
    stopwatch = BatchStopwatch();  // what comes after a batch is no part of the next
  };
  run(episode.exploration, CountingProbe(scene, episode.exploration, world.probe), finish_batch,
      way_step_m(scene));
  return episode;
}

/// When all is felt: as sure as the scene asks to be.
void conclude_finally(const Scene& scene, Episode& episode) {
  const std::optional<std::uint64_t> seed = outlines_seed_of(scene);
  const Conclusion& conclusion = episode.conclusion();
  if (!seed || !conclusion.level || !conclusion.model.level.is_of_edge()) return;
  episode.exploration.draw_outlines(*seed);
  episode.trace.pop_back();
  restate(episode);
}

bool explores_coarsely(const Scene& scene) { return scene.metres("plan.explore_mm") > 0.0; }

Episode explored(const Scene& scene, const Surface& surface, const World& world,
                 const AfterBatch& after_batch) {
  if (is_scan(scene)) return run_scan(scene, surface, world, after_batch);
  return explores_coarsely(scene) ? run_coarse_exploration(scene, surface, world, after_batch)
                                  : run_exploration(scene, surface, world, after_batch);
}

/// A field that cannot be fitted is told with what to change in the scene.
template <typename Run>
auto with_advice(const Scene& scene, const Run& run) {
  try {
    return run();
  } catch (const FieldNotFitted& error) {
    throw NumericalError(scene.name() +
                         ": field: cannot be fitted to the readings: " + error.reason() +
                         ". What helps: field.noise above 0 or learned, a shorter field.length_mm, "
                         "a field.signal_sd like the readings' own");
  }
}

}  // namespace

bool is_scan(const Scene& scene) {
  const std::string strategy = scene.word("plan.acquisition");
  return strategy == "raster" || strategy == "refinement";
}

Episode run_episode(const Scene& scene, const Surface& surface, const World& world,
                    const AfterBatch& after_batch) {
  return with_advice(scene, [&] {
    Episode episode = explored(scene, surface, world, after_batch);
    conclude_finally(scene, episode);
    return episode;
  });
}

Episode episode_from(const Scene& scene, const Surface& surface,
                     std::span<const Palpation> palpations) {
  return with_advice(scene, [&] {
    Episode episode = started(scene, surface, plan_of(scene), {});
    if (palpations.empty()) return episode;
    episode.exploration.take_up(palpations);
    restate(episode);
    conclude_finally(scene, episode);
    return episode;
  });
}

Choice next_of(const Scene& scene, const Surface& surface, const Episode& episode) {
  if (!explores_coarsely(scene)) return episode.exploration.choice();
  return with_advice(scene, [&] {
    const CoarseMesh coarse = coarsen(surface, scene.metres("plan.explore_mm"));
    Exploration planner = coarse_planner(scene, surface, coarse, {});
    planner.take_up(as_planned(planner, coarse, surface, episode.exploration.readings()));
    Choice choice = planner.choice();
    for (int& stop : choice.stops) stop = coarse.vertices[static_cast<std::size_t>(stop)];
    return choice;
  });
}

Snapshot snapshot(const Episode& episode) {
  const Exploration& exploration = episode.exploration;
  const Marginals& marginals = exploration.conclusion().marginals;
  const ReadingScale scale = exploration.conclusion().scale();
  const auto in_readings = [scale](double value) { return as_reading(scale, value); };
  Snapshot now{marginals.mean.unaryExpr(in_readings),
               marginals.variance.cwiseSqrt().binaryExpr(
                   marginals.mean,
                   [scale](double sd, double mean) { return sd * reading_per_step(scale, mean); }),
               acquisition_field(exploration.conclusion(), exploration.plan()),
               {},
               {},
               {},
               {},
               {}};
  if (const Aim& aim = exploration.plan().aim; aim.has_goal())
    now.undetected_mm = 1e3 * diameters_undetected_m(exploration.conclusion(), aim.probability);
  if (exploration.conclusion().belief.prior().has_slope())
    now.mean_detrended = exploration.conclusion().component.mean.unaryExpr(in_readings);
  if (const std::optional<Contour>& contour = exploration.conclusion().contour;
      contour && exploration.conclusion().level && exploration.conclusion().belief.site_count() > 0)
    now.above_level = contour->field.array() - contour->level;
  if (exploration.conclusion().certainty) {
    now.score = exploration.conclusion().certainty->score;
    now.probability_inside = exploration.conclusion().certainty->probability_inside();
  }
  return now;
}

}  // namespace palpation::tool
