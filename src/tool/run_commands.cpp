// simulate, replay, plan, boundary: a scene, and a world or measurements.
#include <algorithm>
#include <cstdio>
#include <memory>

#include "palpation/base/error.h"
#include "palpation/io/measurements.h"
#include "scene/episode.h"
#include "scene/next_plan.h"
#include "scene/output_folder.h"
#include "scene/progress.h"
#include "scene/remarks.h"
#include "scene/setup.h"
#include "scene/stopwatch.h"
#include "scene/tissue.h"
#include "scene/words.h"
#include "scene/worlds.h"
#include "tool/commands.h"

namespace palpation::tool {
namespace {

Scene scene_of(const SceneArguments& arguments) {
  const Scene scene = Scene::read(arguments.scene, arguments.overrides);
  return arguments.seed ? scene.with("seed", *arguments.seed) : scene;
}

template <typename Work>
auto in_sight(const std::string& what, const SceneArguments& arguments, const Work& work) {
  const Stage phase(what, arguments.quiet);
  return work();
}

Tissue tissue_for(const SceneArguments& arguments, const Scene& scene) {
  return in_sight("Preparing the tissue", arguments, [&] { return tissue_of(scene); });
}

/// What the batches bring, told as they come; over before anything else is told.
Episode run_in_sight(const SceneArguments& arguments, const Scene& scene, const Tissue& tissue,
                     const World& world, OutputFolder* output) {
  Progress progress("Batch", scene.integer("plan.batches") + 1, arguments.quiet);
  return run_episode(scene, tissue.surface, world, [&](const Episode& now) {
    progress.step(static_cast<int>(now.trace.size()), batch_words(now));
    if (output) output->write_step(now, &world);
  });
}

std::vector<std::string> joined(std::vector<std::string> some,
                                const std::vector<std::string>& more) {
  some.insert(some.end(), more.begin(), more.end());
  return some;
}

/// Nothing where no folder is asked for. Made before anything is computed, so that one that cannot
/// be costs no time.
std::unique_ptr<OutputFolder> output_of(const SceneArguments& arguments, const std::string& command,
                                        const Scene& scene, const Tissue& tissue,
                                        const std::vector<std::string>& warnings) {
  if (arguments.out.empty()) return nullptr;
  return std::make_unique<OutputFolder>(Destination{arguments.out, command, arguments.overwrite},
                                        scene, tissue, warnings);
}

/// What was found, and what is odd about it; that there is nothing is a finding.
void report(const Episode& episode, bool quiet) {
  if (!quiet) std::fputs(episode_words(episode).c_str(), stdout);
  std::vector<std::string> remarks = boundary_remarks(episode);
  if (!remarks.empty() && remarks.back() == no_level_words(episode.exploration))
    remarks.pop_back();  // it was said already
  tell(remarks);
}

/// The whole run of `simulate` and `replay`, to the files and the words.
void run_and_report(const SceneArguments& arguments, const std::string& command, const Scene& scene,
                    const Tissue& tissue, const World& world, double prepared_seconds) {
  const std::vector<std::string> remarks = joined(start_remarks(tissue), world.warnings);
  std::unique_ptr<OutputFolder> output = output_of(arguments, command, scene, tissue, remarks);
  tell(remarks);
  const Stopwatch running;
  const Episode episode = run_in_sight(arguments, scene, tissue, world, output.get());
  const double running_seconds = running.seconds();
  report(episode, arguments.quiet);
  if (!output) return;

  const Stopwatch writing;
  const Robot robot = robot_of(scene);
  std::vector<SurfacePoint> stops;
  for (int stop : episode.course.stops) stops.push_back(tissue.surface.at_vertex(stop));
  output->write_waypoints(waypoints(tissue.surface, stops, robot),
                          waypoints(tissue.surface, episode.course.way, robot),
                          episode.course.legs);
  output->write(episode, &world,
                {{"prepare_s", prepared_seconds + episode.seconds.start},
                 {"run_s", running_seconds - episode.seconds.start},
                 {"batches_s", episode.seconds.batches},
                 {"write_s", writing.seconds()}});
  output->finish(arguments.quiet);
}

/// What was said when a run started is not said with each of its plans.
bool is_before_second_batch(const std::vector<Palpation>& palpations) {
  return std::ranges::all_of(palpations, [](const Palpation& one) { return one.batch == 0; });
}

/// What is taken for granted of measurements that do not say in which batch they were made.
std::string without_batches(const std::filesystem::path& path, const Scene& scene) {
  const bool has_initial = scene.integer("plan.initial.count") > 0;
  const int left = scene.integer("plan.batches") - (has_initial ? 0 : 1);
  return path.string() + ": there is no column batch: all readings count as one batch, the " +
         (has_initial ? "initial" : "first") + " one, and " + std::to_string(std::max(left, 0)) +
         (left == 1 ? " is left." : " are left.");
}

}  // namespace

void simulate(const SceneArguments& arguments) {
  const Stopwatch preparing;
  const Scene scene = scene_of(arguments);
  const Tissue tissue = tissue_for(arguments, scene);
  const World world = in_sight("Preparing the phantom", arguments,
                               [&] { return simulated_world(scene, tissue.surface); });
  run_and_report(arguments, "simulate", scene, tissue, world, preparing.seconds());
}

void replay(const SceneArguments& arguments, const std::vector<std::filesystem::path>& recordings) {
  const Stopwatch preparing;
  const Scene scene = scene_of(arguments);
  const Tissue tissue = tissue_for(arguments, scene);
  const World world = in_sight("Preparing the recordings", arguments,
                               [&] { return recorded_world(scene, tissue.surface, recordings); });
  run_and_report(arguments, "replay", scene, tissue, world, preparing.seconds());
}

void boundary(const SceneArguments& arguments, const std::filesystem::path& measurements) {
  const Stopwatch running;
  const Scene scene = scene_of(arguments);
  const Tissue tissue = tissue_for(arguments, scene);
  tell(tissue.warnings);
  const MeasurementsFile measured = measured_on(scene, tissue.surface, read_csv(measurements));
  tell(measured.warnings);
  std::unique_ptr<OutputFolder> output =
      output_of(arguments, "boundary", scene, tissue, joined(tissue.warnings, measured.warnings));
  const Episode episode = in_sight("Working out the boundary", arguments, [&] {
    return episode_from(scene, tissue.surface, measured.palpations);
  });
  report(episode, arguments.quiet);
  if (!output) return;
  output->write(episode, nullptr, {{"run_s", running.seconds()}}, measured.foreign);
  output->finish(arguments.quiet);
}

void plan(const SceneArguments& arguments, const std::filesystem::path& measurements) {
  const Stopwatch running;
  const Scene scene = scene_of(arguments);
  check_plans(scene);
  const Tissue tissue = tissue_for(arguments, scene);
  MeasurementsFile measured;  // nothing, at the very start
  if (!measurements.empty()) measured = measured_on(scene, tissue.surface, read_csv(measurements));
  const bool starts = is_before_second_batch(measured.palpations);
  const std::vector<std::string> remarks = starts ? start_remarks(tissue) : tissue.warnings;
  if (starts) tell(remarks);
  tell(measured.warnings);
  std::unique_ptr<OutputFolder> output =
      output_of(arguments, "plan", scene, tissue, joined(remarks, measured.warnings));
  if (!measured.has_batches && !measured.palpations.empty()) {
    const std::string words = without_batches(measurements, scene);
    tell({words});
    if (output) output->warn(words);
  }
  const NextPlan next = in_sight("Choosing the next stops", arguments, [&] {
    return next_plan(scene, tissue.surface, measured.palpations);
  });
  if (!arguments.quiet)
    std::fputs(plan_words(next.episode, next.poses, next.length_m).c_str(), stdout);
  if (!output) return;
  output->write_waypoints(next.poses, next.way, next.legs);
  output->write(next.episode, nullptr, {{"run_s", running.seconds()}}, measured.foreign);
  output->finish(arguments.quiet);
}

}  // namespace palpation::tool
