// experiment figure4: how the error of the paper's three algorithms falls with the readings.
#include <cstdio>

#include "experiments/experiment.h"
#include "experiments/paper_scene.h"
#include "palpation/base/error.h"
#include "scene/draw_program.h"

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
      cells.push_back({percent + ", horseshoe, " + algorithm + ", level known", scene});
    }
  }
  return cells;
}

/// The mean errors after every batch, a row each.
std::string curves(std::span<const std::vector<std::vector<double>>> panel, int initial,
                   int batch) {
  std::string csv = "readings";
  for (const std::string& algorithm : kPaperAlgorithms)
    csv += "," + algorithm + "," + algorithm + "_se";
  csv += "\n";
  for (std::size_t step = 0; step < panel.front().front().size(); ++step) {
    csv += std::to_string(initial + batch * static_cast<int>(step));
    for (const auto& trials : panel) {
      std::vector<double> values;
      for (const auto& trial : trials) {
        if (step < trial.size()) values.push_back(trial[step]);
      }
      const Statistics result = statistics(values);
      csv += "," + text_of(result.mean) + "," + or_empty(result.standard_error);
    }
    csv += "\n";
  }
  return csv;
}

void draw(const ExperimentArguments& arguments, const std::string& name,
          const std::string& percent) {
  const auto no_picture =
      run_draw({"--curves", (arguments.out / (name + ".csv")).string(),
                (arguments.out / (name + ".png")).string(), "--log-y", "--title",
                "Horseshoe, noise " + percent + " % of the range", "--x-label", "readings",
                "--y-label", "symmetric difference, % of the search area"});
  if (no_picture) std::fprintf(stderr, "palpate: no picture: %s\n", no_picture->c_str());
}

}  // namespace

void figure4(const ExperimentArguments& arguments) {
  const Scene base = base_scene(arguments, paper_scene());
  const std::vector<Cell> cells = cells_of(base, !arguments.scene.empty());
  if (printed_scenes(cells, arguments)) return;
  const Errors errors = run_trials(cells, arguments);
  for (std::size_t panel = 0; panel < kNoisePercents.size(); ++panel) {
    const std::string& percent = kNoisePercents[panel];
    const std::string csv =
        curves(std::span(errors).subspan(panel * kPaperAlgorithms.size(), kPaperAlgorithms.size()),
               base.integer("plan.initial.count"), base.integer("plan.batch"));
    std::printf(
        "\nHorseshoe, noise %s %%: symmetric difference in %% of the search area, mean of %d "
        "trials\n%s",
        percent.c_str(), arguments.trials, csv.c_str());
    write_table(arguments, "figure4_noise_" + percent, csv);
    if (!arguments.out.empty()) draw(arguments, "figure4_noise_" + percent, percent);
  }
}

}  // namespace palpation::tool
