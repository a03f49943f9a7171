// experiment figure4: how the error of the paper's three algorithms falls with the readings.
#include <cstdio>

#include "experiments/experiment.h"
#include "experiments/paper_scene.h"
#include "palpation/base/error.h"

namespace palpation::tool {
namespace {

const std::vector<std::string> kNoisePercents = {"5", "25"};

/// One panel per noise, one curve per algorithm.
std::vector<Cell> cells_of(const Scene& base, bool keep_tumours) {
  std::vector<Cell> cells;
  for (const std::string& percent : kNoisePercents) {
    for (const std::string& algorithm : kPaperAlgorithms) {
      Scene scene =
          base.with("probe.noise", std::stod(percent) / 100.0).with("plan.acquisition", algorithm);
      if (!keep_tumours) scene = scene.with("probe.tumours", paper_tumour("horseshoe"));
      const std::string shape = keep_tumours ? base.name() : "Horseshoe";
      cells.push_back({percent + ", " + (keep_tumours ? shape : "horseshoe") + ", " + algorithm +
                           ", level known",
                       scene,
                       Figures()
                           .set("noise_percent", percent)
                           .set("algorithm", algorithm)
                           .set("shape", shape)
                           .set("initial", scene.number("plan.initial.count"))
                           .set("batch", scene.number("plan.batch"))});
    }
  }
  return cells;
}

/// The mean errors after every batch, a row each; `panel` holds the trials of each algorithm.
std::string curves(const std::vector<std::vector<Figures>>& panel) {
  std::string csv = "readings";
  for (const std::string& algorithm : kPaperAlgorithms)
    csv += "," + algorithm + "," + algorithm + "_se";
  csv += "\n";
  const Figures& first = panel.front().front();
  const std::size_t steps = listed(first, "errors_percent").size();
  for (std::size_t step = 0; step < steps; ++step) {
    csv += text_of(first.number("initial") + first.number("batch") * static_cast<double>(step));
    for (const std::vector<Figures>& trials : panel) {
      std::vector<double> values;
      for (const Figures& trial : trials) {
        const std::vector<double> errors = listed(trial, "errors_percent");
        if (step < errors.size()) values.push_back(errors[step]);
      }
      const Statistics result = statistics(values);
      csv += "," + text_of(result.mean) + "," + or_empty(result.standard_error);
    }
    csv += "\n";
  }
  return csv;
}

}  // namespace

Study figure4_study(const ExperimentArguments& arguments) {
  return error_study(cells_of(base_scene(arguments, paper_scene()), !arguments.scene.empty()));
}

void report_figure4(const Results& results, const ReportFolder& folder) {
  for (std::size_t number = 0; number < kNoisePercents.size(); ++number) {
    const std::string& percent = kNoisePercents[number];
    std::vector<std::vector<Figures>> panel;
    for (std::size_t curve = 0; curve < kPaperAlgorithms.size(); ++curve)
      panel.push_back(results.of(number * kPaperAlgorithms.size() + curve));
    const std::string csv = curves(panel),
                      title = panel.front().front().word("shape") + ", noise " + percent + " %";
    std::printf("\n%s: symmetric difference in %% of the search area, mean of %d trials\n%s",
                title.c_str(), results.trials(), csv.c_str());
    const std::string name = "figure4_noise_" + percent;
    folder.write(name, csv);
    folder.draw(name, {"--log-y", "--title", title + " of the range", "--x-label", "readings",
                       "--y-label", "symmetric difference, % of the search area"});
  }
}

}  // namespace palpation::tool
