#include "scene/episode.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "exploration/coarse_run.h"
#include "palpation/base/error.h"
#include "palpation/decision/baseline.h"
#include "palpation/geometry/path.h"
#include "scene/setup.h"
#include "scene/stopwatch.h"

namespace palpation::tool {
namespace {

RegionError error_of(const Episode& episode) {
  const Exploration& exploration = episode.exploration;
  if (!episode.plain_truth || !exploration.level())
    return compare(exploration.surface(), episode.estimate, *episode.truth);
  const Contour contour = exploration.contour();
  return compare(exploration.surface(), Superlevel{contour.field, contour.level},
                 *episode.plain_truth);
}

/// The estimate and its error as they follow from the exploration's state, and a row of the trace.
void restate(Episode& episode) {
  const Exploration& exploration = episode.exploration;
  TraceRow row;
  row.batch = exploration.batch() - 1;
  row.measurements = static_cast<int>(exploration.palpations().size());
  row.path_m = episode.path_m;
  if (exploration.belief().site_count() > 0) {
    episode.estimate = Region();
    if (exploration.level()) {
      const Level level = *exploration.level();
      row.level = level.value;
      if (!exploration.tip_hides_all())
        row.expected_error_m2 = exploration.certainty()->expected.symmetric_difference_m2();
      const Contour contour = exploration.contour();
      episode.estimate = superlevel_region(exploration.surface(), contour.field, contour.level);
    }
    if (episode.truth) episode.error = error_of(episode);
    row.error = episode.error;
  }
  episode.trace.push_back(row);
}

/// What can be touched, of what the robot reaches.
Reach within_reach(const Scene& scene, const Surface& surface, Reach reach) {
  const std::optional<std::vector<int>> reached = reachable_of(scene, surface);
  if (!reached) return reach;
  if (reach.vertices.empty()) {
    reach.vertices = *reached;
    return reach;
  }
  std::erase_if(reach.vertices, [&](int vertex) {
    return !std::binary_search(reached->begin(), reached->end(), vertex);
  });
  if (reach.vertices.empty()) scene.refuse("robot", "reaches no tissue that can be felt");
  return reach;
}

Episode started(const Scene& scene, const Surface& surface, Plan plan, Reach given_reach) {
  Reach reach = within_reach(scene, surface, std::move(given_reach));
  return Episode{
      .exploration = Exploration(surface, model_of(scene), std::move(plan), std::move(reach)),
      .cut_risk = scene.number("band.cut_risk"),
      .band_probability = scene.number("band.probability"),
      .level_fraction = scene.number("level.fraction"),
      .min_contrast = scene.has("plan.min_contrast")
                          ? std::optional(scene.number("plan.min_contrast"))
                          : std::nullopt};
}

Episode started(const Scene& scene, const Surface& surface, const World& world, Plan plan) {
  const Stopwatch starting;
  Episode episode = started(scene, surface, std::move(plan), world.reach);
  episode.truth = superlevel_region(surface, world.truth, world.true_level);
  episode.truth_is = world.truth_is;
  if (scene.word("error.arithmetic") == "plain")
    episode.plain_truth = Superlevel{world.truth, world.true_level};
  episode.start_seconds = starting.seconds();
  return episode;
}

/// A probe that stops the run before it comes to more places than can be modelled.
class CountingProbe {
 public:
  CountingProbe(const Scene& scene, const Exploration& exploration, const Probe& probe)
      : scene_(scene), exploration_(exploration), probe_(probe) {}

  std::optional<Palpation> operator()(const SurfacePoint& where, const Vec3& travel) {
    if (exploration_.batch() != batch_) felt_ = 0;
    batch_ = exploration_.batch();
    if (exploration_.belief().site_count() + ++felt_ > kMostPlaces)
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

struct BatchStopwatch {
  Stopwatch wall;
  CpuStopwatch cpu;
};

/// Of a batch that ends; the next one begins.
void note_time(Episode& episode, BatchStopwatch& stopwatch) {
  episode.batch_seconds.push_back(stopwatch.wall.seconds());
  episode.batch_cpu_seconds.push_back(stopwatch.cpu.seconds());
  stopwatch = BatchStopwatch();
}

/// The tour of the last `stop_count` stops.
void add_tour(Episode& episode, const Tour& tour, std::size_t stop_count) {
  for (const int leg : tour.legs)
    episode.legs.push_back(static_cast<int>(episode.stops.size() - stop_count) + leg);
  episode.way.insert(episode.way.end(), tour.way.begin(), tour.way.end());
  episode.path_m += tour.length_m;
}

double way_step_m(const Scene& scene) {
  return scene.truth("plan.readings_along_path") ? kWayStep_m : 0.0;
}

/// What the coarse mesh can be touched at.
Reach coarse_reach(const Scene& scene, const Surface& surface, const CoarseMesh& coarse,
                   const Reach& given) {
  const Reach fine = within_reach(scene, surface, given);
  Reach reach{.touch_once = fine.touch_once};
  if (fine.vertices.empty()) return reach;
  reach.vertices = on_coarse(coarse, fine.vertices);
  if (reach.vertices.empty())
    scene.refuse_value("plan.explore_mm",
                       "finer: none of the vertices that are left can be touched");
  return reach;
}

/// Plans on a coarse mesh; when all is felt, concludes on the whole one.
Episode run_coarse_exploration(const Scene& scene, const Surface& surface, const World& world,
                               const AfterBatch& after_batch) {
  const Stopwatch starting;
  const CoarseMesh coarse = coarsen(surface, scene.metres("plan.explore_mm"));
  const Plan plan = plan_of(scene);
  if (std::max(plan.initial.count, plan.batch.size) > static_cast<int>(coarse.vertices.size()))
    scene.refuse_value("plan.explore_mm", "finer: it leaves " +
                                              std::to_string(coarse.vertices.size()) +
                                              " vertices, fewer than are touched at once");
  Exploration planner(Surface(coarse.mesh), model_of(scene), plan,
                      coarse_reach(scene, surface, coarse, world.reach));
  Plan nothing = plan;
  nothing.initial.count = nothing.batches = 0;
  Episode episode = started(scene, surface, world, nothing);
  episode.start_seconds = starting.seconds();
  BatchStopwatch stopwatch;
  std::vector<int> planned = planner.next();
  const auto finish_batch = [&](const Tour& tour) {
    for (const int stop : planned)
      episode.stops.push_back(coarse.vertices[static_cast<std::size_t>(stop)]);
    add_tour(episode, tour, planned.size());
    planned = planner.next();
    TraceRow row;
    row.batch = planner.batch() - 1;
    row.measurements = static_cast<int>(planner.palpations().size());
    row.path_m = episode.path_m;
    if (planner.level()) row.level = planner.level()->value;
    if (planner.certainty())
      row.expected_error_m2 = planner.certainty()->expected.symmetric_difference_m2();
    if (!planned.empty()) episode.trace.push_back(row);  // the last one is of the conclusion
    note_time(episode, stopwatch);
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
    episode.stops.insert(episode.stops.end(), planned.begin(), planned.end());
    add_tour(episode, tour, planned.size());
    planned = episode.exploration.next();
    restate(episode);
    note_time(episode, stopwatch);
    if (after_batch) after_batch(episode);
    stopwatch = BatchStopwatch();
  };
  run(episode.exploration, CountingProbe(scene, episode.exploration, world.probe), finish_batch,
      way_step_m(scene));
  return episode;
}

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
  const std::size_t count = static_cast<std::size_t>(exploration.belief().site_count()) + more;
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
    episode.path_m += step.norm();
    const Vec3 heading = step.norm() > 0.0 ? step.normalized() : Vec3(Vec3::Zero());
    if (std::optional<Palpation> palpation = probe(places[i], heading)) {
      palpation->batch = episode.exploration.batch();
      if (palpation->travel.isZero(0.0)) palpation->travel = heading;
      fresh.push_back(*palpation);
    }
    previous = here;
  }
  felt.insert(felt.end(), fresh.begin(), fresh.end());
  episode.exploration.take_up(fresh);
}

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
    note_time(episode, stopwatch);
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
    places =
        refinement.next(episode.exploration.level() ? episode.exploration.level()->value : 0.0);
  }
  return episode;
}

/// A field that cannot be fitted is told with what to change in the scene.
template <typename Run>
Episode with_advice(const Scene& scene, const Run& run) {
  try {
    return run();
  } catch (const NumericalError& error) {
    const std::string words = error.what();
    if (!words.starts_with("Belief: ") && !words.starts_with("learn: ")) throw;
    throw NumericalError(scene.name() + ": field: cannot be fitted to the readings: " +
                         words.substr(words.find(": ") + 2) +
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
    if (is_scan(scene)) return run_scan(scene, surface, world, after_batch);
    return scene.metres("plan.explore_mm") > 0.0
               ? run_coarse_exploration(scene, surface, world, after_batch)
               : run_exploration(scene, surface, world, after_batch);
  });
}

Episode episode_from(const Scene& scene, const Surface& surface,
                     std::span<const Palpation> palpations) {
  return with_advice(scene, [&] {
    Episode episode = started(scene, surface, plan_of(scene), {});
    if (palpations.empty()) return episode;
    episode.exploration.take_up(palpations);
    restate(episode);
    return episode;
  });
}

Snapshot snapshot(const Episode& episode) {
  const Exploration& exploration = episode.exploration;
  const Marginals& marginals = exploration.marginals();
  Snapshot now{
      marginals.mean, marginals.variance.cwiseSqrt(), exploration.acquisition_field(), {}, {}, {}};
  if (exploration.belief().prior().has_slope()) now.mean_detrended = exploration.component().mean;
  if (exploration.certainty()) {
    now.score = exploration.certainty()->score;
    now.probability_inside = exploration.certainty()->probability_inside();
  }
  return now;
}

}  // namespace palpation::tool
