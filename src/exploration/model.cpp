#include "palpation/exploration/model.h"

#include "palpation/base/error.h"
#include "palpation/exploration/plan.h"

namespace palpation {

Kernel kernel_of(const KernelModel& model) {
  return {.family = model.family,
          .length_m = model.length_m.value_or(model.length_median_m),
          .signal_sd = model.signal_sd.value_or(1.0),
          .period_m = model.period_m};
}

void check(const Model& model) {
  const double fraction = model.level.fraction, probability = model.band_probability;
  require(fraction > 0.0 && fraction < 1.0, "LevelRule", "fraction = " + text_of(fraction),
          "must lie in (0, 1)");
  require(probability > 0.0 && probability < 1.0, "Model",
          "band_probability = " + text_of(probability), "must lie in (0, 1)");
}

void check(const Plan& plan) {
  require(plan.initial.count >= 0, "Plan", "initial.count = " + std::to_string(plan.initial.count),
          "must not be negative");
  require(plan.edge_share >= 0.0 && plan.edge_share <= 1.0, "Plan",
          "edge_share = " + text_of(plan.edge_share), "must lie in [0, 1]");
  require(plan.batches >= 0, "Plan", "batches = " + std::to_string(plan.batches),
          "must not be negative");
  check(plan.stop);
}

}  // namespace palpation
