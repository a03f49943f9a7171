// experiment tradeoff: what each way to be faster costs on a scene, and which to take.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "experiments/experiment.h"
#include "experiments/peak_memory.h"
#include "palpation/base/error.h"
#include "scene/draw_program.h"
#include "scene/speed.h"
#include "scene/stopwatch.h"
#include "scene/tissue.h"
#include "scene/words.h"
#include "scene/worlds.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

constexpr double kMm2 = 1e6;
/// Not worse: by no more than chance explains, or by less than this part of exact's error.
constexpr double kStandardErrors = 2.0;
constexpr double kNegligible = 0.05;
/// Few trials explain anything by chance: no more than this part of exact's error passes as that.
constexpr double kTolerable = 0.15;
/// To be worth a change of the scene, a run must take so many times less.
constexpr double kWorthIt = 1.2;
constexpr int kFewTrials = 5;

/// A way to be faster.
struct Choice {
  std::string name;
  std::vector<SpeedPart> parts;
};

struct Outcome {
  Region estimate{};
  double error_m2 = 0.0;
  double from_exact_m2 = 0.0;
  double batch_s = 0.0;  ///< the median
  double run_s = 0.0;
};

struct Result {
  std::vector<Outcome> trials{};
  std::optional<double> memory_mb{};
  std::string refusal{};  ///< why there are no trials
};

/// All that a scene may change to be faster, each where it makes sense on this tissue; the first is
/// exact.
std::vector<Choice> choices_for(const Scene& scene, const Surface& surface) {
  std::vector<Choice> choices = {
      {"exact", {}}, {"fast", speed_parts("fast")}, {"draft", speed_parts("draft")}};
  for (const double explore_mm : {0.5, 1.0, 2.0})
    choices.push_back(
        {"plan on " + fixed(explore_mm, 1) + " mm", {{"plan.explore_mm", explore_mm}}});
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
                           "field.precision", "field.reduced_rank"})
    scene = scene.with(path, exact_value(path));
  return scene;
}

Scene with_parts(Scene scene, const std::vector<SpeedPart>& parts) {
  for (const SpeedPart& part : parts) scene = scene.with(part.path, part.value);
  return scene;
}

/// Seconds are those of the processor, one thread: what others do on the machine does not count.
Outcome outcome_of(const Scene& scene, const Surface& tissue) {
  const World world = simulated_world(scene, tissue);
  const Surface fresh(tissue.mesh());  // chart and waves are part of the price
  const CpuStopwatch running;
  const Episode episode = run_episode(scene, fresh, world);
  Outcome outcome{.estimate = episode.estimate, .run_s = running.seconds()};
  outcome.batch_s = median(episode.batch_cpu_seconds);
  outcome.error_m2 = episode.error ? episode.error->symmetric_difference_m2 : tissue.area();
  return outcome;
}

/// One run by itself, for its memory; or why it cannot be made.
Result probed(const Scene& scene, const Surface& tissue, std::uint64_t seed) {
  Result result;
  try {
    const PeakMemory memory;
    outcome_of(scene.with("seed", seed), tissue);
    result.memory_mb = memory.megabytes();
  } catch (const Error& error) {
    result.refusal = error.what();
  }
  return result;
}

Statistics over(const Result& result, double (*value)(const Outcome&)) {
  std::vector<double> values;
  for (const Outcome& trial : result.trials) values.push_back(value(trial));
  return statistics(values);
}

double median_over(const Result& result, double (*value)(const Outcome&)) {
  std::vector<double> values;
  for (const Outcome& trial : result.trials) values.push_back(value(trial));
  return median(values);
}

double error_mm2(const Outcome& outcome) { return outcome.error_m2 * kMm2; }
double from_exact_mm2(const Outcome& outcome) { return outcome.from_exact_m2 * kMm2; }
double batch_ms(const Outcome& outcome) { return outcome.batch_s * 1e3; }
double run_s(const Outcome& outcome) { return outcome.run_s; }

/// How much more is wrong than with exact, seed by seed.
Statistics excess_mm2(const Result& result, const Result& exact) {
  std::vector<double> values;
  for (std::size_t trial = 0; trial < result.trials.size(); ++trial)
    values.push_back(error_mm2(result.trials[trial]) - error_mm2(exact.trials[trial]));
  return statistics(values);
}

/// Of these, the ones that no other beats in both time and error; in the order of time.
std::vector<std::size_t> pareto_front(const std::vector<Result>& results) {
  std::vector<std::size_t> order, front;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (results[i].refusal.empty()) order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(median_over(results[a], run_s), over(results[a], error_mm2).mean) <
           std::pair(median_over(results[b], run_s), over(results[b], error_mm2).mean);
  });
  for (const std::size_t i : order) {
    if (front.empty() ||
        over(results[i], error_mm2).mean < over(results[front.back()], error_mm2).mean)
      front.push_back(i);
  }
  return front;
}

/// The fastest that is no worse than exact as far as the trials tell.
std::string advice(const std::vector<Choice>& choices, const std::vector<Result>& results) {
  const Result& exact = results.front();
  const double exact_error = over(exact, error_mm2).mean, exact_s = median_over(exact, run_s);
  std::size_t best = 0;
  for (std::size_t i = 1; i < results.size(); ++i) {
    if (!results[i].refusal.empty()) continue;
    const Statistics excess = excess_mm2(results[i], exact);
    const double chance =
        std::min(kStandardErrors * excess.standard_error.value_or(0.0), kTolerable * exact_error);
    const bool pays = kWorthIt * median_over(results[i], run_s) < exact_s;
    if (pays && excess.mean <= std::max(chance, kNegligible * exact_error) &&
        median_over(results[i], run_s) < median_over(results[best], run_s))
      best = i;
  }
  if (best == 0)
    return "Keep speed exact: nothing that is faster by a fifth or more is as good here.";
  const Statistics excess = excess_mm2(results[best], exact);
  std::string settings;
  for (const SpeedPart& part : choices[best].parts)
    settings += " --set " + part.path + "=" +
                (part.value.is_string() ? part.value.get<std::string>() : part.value.dump());
  return "Take " + choices[best].name + " (" + settings.substr(1) + "): a run takes " +
         fixed(exact_s / median_over(results[best], run_s), 1) +
         " times less than exact, and its wrong area is " +
         fixed(over(results[best], error_mm2).mean, 2) + " mm2 against " + fixed(exact_error, 2) +
         " mm2, a difference of " + fixed(excess.mean, 2) + " +- " +
         fixed(excess.standard_error.value_or(0.0), 2) + " mm2 seed by seed." +
         (exact.trials.size() < kFewTrials ? " So few trials are a hint, no more: --trials 20."
                                           : "");
}

/// A marker for each choice, and below them the line of those that no other beats.
void draw(const ExperimentArguments& arguments, const std::vector<Choice>& choices,
          const std::vector<Result>& results) {
  std::string csv = "seconds,Pareto front";
  for (const Choice& choice : choices) csv += "," + choice.name + "," + choice.name + "_se";
  csv += "\n";
  const auto row = [&](std::size_t shown, bool on_front) {
    const Statistics error = over(results[shown], error_mm2);
    csv +=
        text_of(median_over(results[shown], run_s)) + "," + (on_front ? text_of(error.mean) : "");
    for (std::size_t i = 0; i < choices.size(); ++i)
      csv += i == shown && !on_front
                 ? "," + text_of(error.mean) + "," + or_empty(error.standard_error)
                 : ",,";
    csv += "\n";
  };
  for (const std::size_t i : pareto_front(results)) row(i, true);
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (results[i].refusal.empty()) row(i, false);
  }
  write_table(arguments, "tradeoff_front", csv);
  const auto no_picture = run_draw(
      {"--curves", (arguments.out / "tradeoff_front.csv").string(),
       (arguments.out / "tradeoff.png").string(), "--title", "What is faster, and what it costs",
       "--x-label", "seconds of one processor for a whole run", "--y-label", "wrong area, mm2"});
  if (no_picture) std::fprintf(stderr, "palpate: no picture: %s\n", no_picture->c_str());
}

}  // namespace

void tradeoff(const ExperimentArguments& arguments) {
  if (arguments.scene.empty())
    throw InvalidInput(
        "experiment tradeoff: needs a scene: it tells what is worth while there, such as "
        "examples/planar.json");
  const Scene base = exact_scene(base_scene(arguments, json::object()));
  const Tissue tissue = tissue_of(base);
  const std::vector<Choice> choices = choices_for(base, tissue.surface);
  std::vector<Cell> cells;
  for (const Choice& choice : choices)
    cells.push_back({choice.name, with_parts(base, choice.parts)});
  if (printed_scenes(cells, arguments)) return;

  std::vector<Result> results;
  for (const Cell& cell : cells) {
    results.push_back(probed(cell.scene, tissue.surface, arguments.first_seed));
    if (results.back().refusal.empty())
      results.back().trials.resize(static_cast<std::size_t>(arguments.trials));
  }
  if (!results.front().refusal.empty()) throw InvalidInput(results.front().refusal);
  for_trials(cells.size(), arguments, [&](std::size_t cell, std::size_t trial, std::uint64_t seed) {
    if (results[cell].refusal.empty())
      results[cell].trials[trial] =
          outcome_of(cells[cell].scene.with("seed", seed), tissue.surface);
  });
  for (Result& result : results) {
    for (std::size_t trial = 0; trial < result.trials.size(); ++trial) {
      result.trials[trial].from_exact_m2 = compare(tissue.surface, result.trials[trial].estimate,
                                                   results.front().trials[trial].estimate)
                                               .symmetric_difference_m2;
    }
  }

  std::printf(
      "\n%s: %d vertices, %d trials; seconds of one processor, medians; areas: mean +- standard "
      "error\n",
      base.name().c_str(), tissue.surface.vertex_count(), arguments.trials);
  std::printf("%-20s%10s%10s%10s%10s%22s%22s\n", "", "batch ms", "run s", "of exact", "MB",
              "mm2 from exact", "mm2 wrong");
  std::string csv =
      "choice,trials,batch_ms,run_s,of_exact,memory_mb,from_exact_mm2,from_exact_se,error_mm2,"
      "error_se\n";
  const double exact_s = median_over(results.front(), run_s);
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const Result& result = results[i];
    if (!result.refusal.empty()) {
      std::printf("%-20s refused: %s\n", choices[i].name.c_str(), result.refusal.c_str());
      continue;
    }
    const Statistics from_exact = over(result, from_exact_mm2), error = over(result, error_mm2);
    const double batch = median_over(result, batch_ms), seconds = median_over(result, run_s);
    std::printf("%-20s%10.1f%10.2f%10.2f%10s%22s%22s\n", choices[i].name.c_str(), batch, seconds,
                seconds / exact_s, result.memory_mb ? fixed(*result.memory_mb, 0).c_str() : "-",
                in_words(from_exact).c_str(), in_words(error).c_str());
    csv += choices[i].name + "," + std::to_string(arguments.trials) + "," + text_of(batch) + "," +
           text_of(seconds) + "," + text_of(seconds / exact_s) + "," + or_empty(result.memory_mb) +
           "," + text_of(from_exact.mean) + "," + or_empty(from_exact.standard_error) + "," +
           text_of(error.mean) + "," + or_empty(error.standard_error) + "\n";
  }
  std::printf("\n%s\n", advice(choices, results).c_str());
  write_table(arguments, "tradeoff", csv);
  if (!arguments.out.empty()) draw(arguments, choices, results);
}

}  // namespace palpation::tool
