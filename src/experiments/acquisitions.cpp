// experiment acquisitions: which criterion the default should be. The level is unknown to all of
// them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "experiments/experiment.h"
#include "experiments/paper_scene.h"
#include "palpation/base/error.h"

namespace palpation::tool {
namespace {

constexpr std::array kCriteria = {
    "auto", "straddle", "randomized-straddle", "expected-error", "ils-ucb", "ucb", "evr", "random"};
constexpr std::array kPercents = {1, 5, 10, 25};

}  // namespace

Study acquisitions_study(const ExperimentArguments& arguments) {
  const Scene base = base_scene(arguments, default_scene());
  std::vector<Cell> cells;
  for (const char* criterion : kCriteria) {
    for (const std::string& shape : kPaperShapes) {
      for (const int percent : kPercents) {
        const std::string noise = std::to_string(percent);
        cells.push_back({std::string(criterion) + ", " + shape + ", noise " + noise + " %",
                         base.with("plan.acquisition", criterion)
                             .with("probe.tumours", paper_tumour(shape))
                             .with("probe.noise", percent / 100.0),
                         Figures()
                             .set("acquisition", criterion)
                             .set("shape", shape)
                             .set("noise_percent", noise)});
      }
    }
  }
  return error_study(std::move(cells));
}

void report_acquisitions(const Results& results, const ReportFolder& folder) {
  std::printf(
      "\nSymmetric difference, %% of the search area, level unknown: mean +- standard error of %d "
      "trials\n",
      results.trials());
  std::printf("%-22s", "");
  for (const std::string& shape : kPaperShapes) {
    for (const int percent : kPercents)
      std::printf("%-17s", (shape + " " + std::to_string(percent) + " %").c_str());
  }
  std::printf("over auto's\n");
  std::string csv = std::string("acquisition,shape,noise_percent,trials,error_percent,") +
                    kStatisticsColumns + "\n";
  const std::size_t columns = kPaperShapes.size() * kPercents.size();
  std::vector<double> of_auto;
  for (std::size_t row = 0; row < kCriteria.size(); ++row) {
    std::printf("%-22s", kCriteria[row]);
    double log_ratio = 0.0;
    for (std::size_t column = 0; column < columns; ++column) {
      const std::vector<Figures> trials = results.of(row * columns + column);
      const Statistics result = statistics(trials, "error_percent");
      if (row == 0) of_auto.push_back(result.mean);
      log_ratio += std::log(result.mean / of_auto[column]) / static_cast<double>(columns);
      std::printf("%-17s", in_words(result).c_str());
      csv += trials.front().word("acquisition") + "," + trials.front().word("shape") + "," +
             trials.front().word("noise_percent") + "," + std::to_string(trials.size()) + "," +
             csv_of(result) + "\n";
    }
    std::printf("%.2f\n", std::exp(log_ratio));
  }
  folder.write("acquisitions", csv);
}

}  // namespace palpation::tool
