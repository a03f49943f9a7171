// What the trials of experiment tradeoff say: a table, its front, and which choice to take.
#include <algorithm>
#include <cstdio>

#include "experiments/experiment.h"
#include "palpation/base/error.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

/// Not worse: by no more than chance explains, or by less than this part of exact's error.
constexpr double kStandardErrors = 2.0;
constexpr double kNegligible = 0.05;
/// Few trials explain anything by chance: no more than this part of exact's error passes as that.
constexpr double kTolerable = 0.15;
/// To be worth a change of the scene, a run must take so many times less.
constexpr double kWorthIt = 1.2;
constexpr int kFewTrials = 5;

/// What the trials say of a choice.
struct Result {
  std::string name, settings, refusal;
  std::vector<Figures> trials;
  std::optional<double> memory_mb{};

  Statistics over(const std::string& figure) const { return statistics(trials, figure); }
  double median_over(const std::string& figure) const { return median(values_of(trials, figure)); }
};

std::vector<Result> results_by_choice(const Results& results) {
  std::vector<Result> all;
  for (const Figures& row : results.of(kTradeoffTrials)) {
    auto found = std::ranges::find(all, row.word("choice"), &Result::name);
    if (found == all.end()) {
      all.push_back({row.word("choice"), row.word("settings"), {}, {}});
      found = all.end() - 1;
    }
    if (!row.word("refusal").empty()) found->refusal = row.word("refusal");
    found->trials.push_back(row);
  }
  for (const Figures& row : results.of(kTradeoffMemory)) {
    const auto found = std::ranges::find(all, row.word("choice"), &Result::name);
    if (found != all.end()) found->memory_mb = row.maybe_number("peak_mb");
  }
  return all;
}

/// How much more is wrong than with exact, seed by seed.
Statistics excess_mm2(const Result& result, const Result& exact) {
  std::vector<double> values;
  for (std::size_t trial = 0; trial < result.trials.size(); ++trial)
    values.push_back(result.trials[trial].number("error_mm2") -
                     exact.trials[trial].number("error_mm2"));
  return statistics(values);
}

/// Of these, the ones that no other beats in both time and error; in the order of time.
std::vector<std::size_t> pareto_front(const std::vector<Result>& results) {
  std::vector<std::size_t> order, front;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (results[i].refusal.empty()) order.push_back(i);
  }
  const auto error = [&](std::size_t i) { return results[i].over("error_mm2").mean; };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(results[a].median_over("run_s"), error(a)) <
           std::pair(results[b].median_over("run_s"), error(b));
  });
  for (const std::size_t i : order) {
    if (front.empty() || error(i) < error(front.back())) front.push_back(i);
  }
  return front;
}

/// The fastest that is no worse than exact as far as the trials tell.
std::string advice(const std::vector<Result>& results) {
  const Result& exact = results.front();
  const double exact_error = exact.over("error_mm2").mean, exact_s = exact.median_over("run_s");
  std::size_t best = 0;
  for (std::size_t i = 1; i < results.size(); ++i) {
    if (!results[i].refusal.empty()) continue;
    const Statistics excess = excess_mm2(results[i], exact);
    const double chance =
        std::min(kStandardErrors * excess.standard_error.value_or(0.0), kTolerable * exact_error);
    const bool pays = kWorthIt * results[i].median_over("run_s") < exact_s;
    if (pays && excess.mean <= std::max(chance, kNegligible * exact_error) &&
        results[i].median_over("run_s") < results[best].median_over("run_s"))
      best = i;
  }
  if (best == 0)
    return "Keep speed exact: nothing that is faster by a fifth or more is as good here.";
  const Statistics excess = excess_mm2(results[best], exact);
  return "Take " + results[best].name + " (" + results[best].settings + "): a run takes " +
         fixed(exact_s / results[best].median_over("run_s"), 1) +
         " times less than exact, and its wrong area is " +
         fixed(results[best].over("error_mm2").mean, 2) + " mm2 against " + fixed(exact_error, 2) +
         " mm2, a difference of " + fixed(excess.mean, 2) + " +- " +
         fixed(excess.standard_error.value_or(0.0), 2) + " mm2 seed by seed." +
         (exact.trials.size() < kFewTrials ? " So few trials are a hint, no more: --trials 20."
                                           : "");
}

/// A marker for each choice, and below them the line of those that no other beats.
void draw(const std::vector<Result>& results, const ReportFolder& folder) {
  std::string csv = "seconds,Pareto front";
  for (const Result& result : results) csv += "," + result.name + "," + result.name + "_se";
  csv += "\n";
  const auto row = [&](std::size_t shown, bool on_front) {
    const Statistics error = results[shown].over("error_mm2");
    csv +=
        text_of(results[shown].median_over("run_s")) + "," + (on_front ? text_of(error.mean) : "");
    for (std::size_t i = 0; i < results.size(); ++i)
      csv += i == shown && !on_front
                 ? "," + text_of(error.mean) + "," + or_empty(error.standard_error)
                 : ",,";
    csv += "\n";
  };
  for (const std::size_t i : pareto_front(results)) row(i, true);
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (results[i].refusal.empty()) row(i, false);
  }
  folder.write("tradeoff", csv);
  folder.draw("tradeoff",
              {"--title", "What is faster, and what it costs", "--x-label",
               "seconds of one processor for a whole run", "--y-label", "wrong area, mm2"});
}

void report_choice(const Result& result, double exact_s, std::string& areas, std::string& times) {
  if (!result.refusal.empty()) {
    std::printf("%-20s refused: %s\n", result.name.c_str(), result.refusal.c_str());
    return;
  }
  const Statistics from_exact = result.over("from_exact_mm2"), error = result.over("error_mm2");
  const double batch_ms = 1e3 * result.median_over("batch_s"), run_s = result.median_over("run_s");
  std::printf("%-20s%10.1f%10.2f%10.2f%10s%22s%22s\n", result.name.c_str(), batch_ms, run_s,
              run_s / exact_s, result.memory_mb ? fixed(*result.memory_mb, 0).c_str() : "-",
              in_words(from_exact).c_str(), in_words(error).c_str());
  areas += result.name + "," + std::to_string(result.trials.size()) + "," +
           text_of(from_exact.mean) + "," + or_empty(from_exact.standard_error) + "," +
           csv_of(error) + "\n";
  times += result.name + "," + text_of(batch_ms) + "," + text_of(run_s) + "," +
           text_of(run_s / exact_s) + "," + or_empty(result.memory_mb) + "\n";
}

}  // namespace

void report_tradeoff(const Results& results, const ReportFolder& folder) {
  const std::vector<Result> choices = results_by_choice(results);
  std::printf(
      "\n%s: %s vertices, %d trials; seconds of one processor, medians; areas: mean +- standard "
      "error\n",
      results.manifest.facts.at("scene").c_str(), results.manifest.facts.at("vertices").c_str(),
      results.trials());
  std::printf("%-20s%10s%10s%10s%10s%22s%22s\n", "", "batch ms", "run s", "of exact", "MB",
              "mm2 from exact", "mm2 wrong");
  std::string areas = std::string("choice,trials,from_exact_mm2,from_exact_se,error_mm2,") +
                      kStatisticsColumns + "\n";
  std::string times = "choice,batch_ms,run_s,of_exact,memory_mb\n";
  const double exact_s = choices.front().median_over("run_s");
  for (const Result& choice : choices) report_choice(choice, exact_s, areas, times);
  std::printf("\n%s\n", advice(choices).c_str());
  folder.write("tradeoff_areas", areas);
  folder.write("tradeoff_times", times);
  draw(choices, folder);
}

}  // namespace palpation::tool
