// experiment tradeoff: what each way to be faster costs on a scene, and which to take.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "experiments/experiment.h"
#include "experiments/lazy_tissue.h"
#include "experiments/peak_memory.h"
#include "palpation/base/error.h"
#include "scene/speed.h"
#include "scene/stopwatch.h"
#include "scene/words.h"
#include "scene/worlds.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

constexpr double kMm2 = 1e6;
/// A way to be faster.
struct Choice {
  std::string name;
  std::vector<SpeedPart> parts;
};

/// All that a scene may change to be faster, each where it makes sense on this tissue; the first is
/// exact.
std::vector<Choice> choices_for(const Scene& scene, const Surface& surface) {
  std::vector<Choice> choices = {
      {"exact", {}}, {"fast", speed_parts("fast")}, {"draft", speed_parts("draft")}};
  for (const double explore_mm : {0.5, 1.0, 2.0})
    choices.push_back(
        {"plan on " + fixed(explore_mm, 1) + " mm", {{"plan.explore_mm", explore_mm}}});
  choices.push_back({"Laplace's certainty", {{"certainty", "laplace"}}});
  choices.push_back({"no certainty", {{"certainty", "off"}}});
  choices.push_back({"plain arithmetic", {{"error.arithmetic", "plain"}}});
  choices.push_back({"grown field", {{"field.rebuild_gain", 0.5}}});
  choices.push_back({"single precision", {{"field.precision", "single"}}});
  choices.push_back({"reduced rank", {{"field.reduced_rank", 1e-10}}});
  if (surface.is_planar()) return choices;  // where all metrics are one
  for (const char* metric : {"chart", "ambient", "intrinsic"}) {
    if (scene.word("field.metric") != metric)
      choices.push_back({std::string("metric ") + metric, {{"field.metric", metric}}});
  }
  return choices;
}

/// The scene without its own ways to be faster.
Scene exact_scene(Scene scene) {
  scene = scene.with("speed", "exact");
  for (const char* path : {"plan.explore_mm", "error.arithmetic", "field.rebuild_gain",
                           "field.precision", "field.reduced_rank", "certainty"})
    scene = scene.with(path, exact_value(path));
  return scene;
}

Scene with_parts(Scene scene, const std::vector<SpeedPart>& parts) {
  for (const SpeedPart& part : parts) scene = scene.with(part.path, part.value);
  return scene;
}

struct Outcome {
  Region estimate;
  Figures figures;
};

/// Seconds are those of the processor, one thread: what others do on the machine does not count.
Outcome outcome_of(const Scene& scene, const Surface& tissue) {
  const World world = simulated_world(scene, tissue);
  const Surface fresh(tissue.mesh());  // chart and waves are part of the price
  const CpuStopwatch running;
  const Episode episode = run_episode(scene, fresh, world);
  const double error_m2 = episode.error ? episode.error->symmetric_difference_m2 : tissue.area();
  return {episode.estimate, Figures()
                                .set("run_s", running.seconds())
                                .set("batch_s", median(episode.seconds.batches_cpu))
                                .set("error_mm2", error_m2 * kMm2)};
}

std::string settings_of(const Choice& choice) {
  std::string settings;
  for (const SpeedPart& part : choice.parts)
    settings += " --set " + part.path + "=" +
                (part.value.is_string() ? part.value.get<std::string>() : part.value.dump());
  return settings.empty() ? settings : settings.substr(1);
}

/// One seed by every choice, a row each: what makes areas comparable is that exact runs beside
/// them.
std::vector<Figures> trial_of(const std::vector<Choice>& choices, const Scene& exact,
                              const Surface& tissue) {
  std::vector<Figures> rows;
  std::optional<Region> of_exact;
  for (const Choice& choice : choices) {
    Figures row;
    try {
      Outcome outcome = outcome_of(with_parts(exact, choice.parts), tissue);
      if (!of_exact) of_exact = outcome.estimate;
      row = std::move(outcome.figures);
      const RegionError apart = compare(tissue, outcome.estimate, *of_exact);
      row.set("from_exact_mm2", apart.symmetric_difference_m2 * kMm2);
    } catch (const Error& error) {
      if (!of_exact) throw;
      row.set("refusal", error.what());
    }
    rows.push_back(row.set("choice", choice.name).set("settings", settings_of(choice)));
  }
  return rows;
}

/// One run of each choice by itself, for its memory.
std::vector<Figures> memory_of(const std::vector<Choice>& choices, const Scene& exact,
                               const Surface& tissue) {
  std::vector<Figures> rows;
  for (const Choice& choice : choices) {
    Figures row;
    try {
      const PeakMemory memory;
      outcome_of(with_parts(exact, choice.parts), tissue);
      row.set("peak_mb", memory.megabytes());
    } catch (const Error& error) {
      row.set("refusal", error.what());
    }
    rows.push_back(row.set("choice", choice.name));
  }
  return rows;
}

}  // namespace

Study tradeoff_study(const ExperimentArguments& arguments) {
  if (arguments.scene.empty())
    throw InvalidInput(
        "experiment tradeoff: needs a scene: it tells what is worth while there, such as "
        "examples/planar.json");
  const Scene base = exact_scene(base_scene(arguments, json::object()));
  const LazyTissue tissue(base);
  const std::vector<Choice> choices = choices_for(base, tissue.surface());
  Study study{.columns = {"choice", "settings", "refusal", "error_mm2", "from_exact_mm2", "batch_s",
                          "run_s", "peak_mb"},
              .facts = {{"scene", std::filesystem::path(base.name()).filename().string()},
                        {"vertices", std::to_string(tissue.surface().vertex_count())}}};
  // In the order of kTradeoffTrials and kTradeoffMemory.
  study.cells = {{.name = "every choice", .scene = base},
                 {.name = "memory", .scene = base, .trials = 1, .alone = true}};
  for (const Choice& choice : choices)
    study.printed.push_back({choice.name, with_parts(base, choice.parts)});
  study.mesh_digest = [tissue](std::size_t) { return tissue.mesh_digest(); };
  study.run = [=](std::size_t cell, std::uint64_t seed) {
    const Scene scene = base.with("seed", seed);
    return cell == kTradeoffTrials ? trial_of(choices, scene, tissue.surface())
                                   : memory_of(choices, scene, tissue.surface());
  };
  return study;
}

}  // namespace palpation::tool
