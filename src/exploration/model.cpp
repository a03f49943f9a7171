#include "palpation/exploration/model.h"

#include <cmath>

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
  const double fraction = model.level.fraction;
  const Band band = model.band.value_or(Band{});
  require(fraction > 0.0 && fraction < 1.0, "LevelRule", "fraction = " + text_of(fraction),
          "must lie in (0, 1)");
  require(band.probability > 0.0 && band.probability < 1.0, "Model",
          "band.probability = " + text_of(band.probability), "must lie in (0, 1)");
  require(std::isfinite(band.place_sd_m) && band.place_sd_m >= 0.0, "Model",
          "band.place_sd_m = " + text_of(band.place_sd_m), "must be finite and not negative");
  const Contrast& contrast = model.contrast;
  if (!contrast.least) return;
  const bool is_factor = contrast.scale == ReadingScale::Log;
  require(std::isfinite(*contrast.least) && *contrast.least > (is_factor ? 1.0 : 0.0), "Contrast",
          "least = " + text_of(*contrast.least),
          is_factor ? "must be finite and above 1, being a factor of logarithms"
                    : "must be finite and positive");
}

void check(const Plan& plan) {
  require(plan.initial.count >= 0, "Plan", "initial.count = " + std::to_string(plan.initial.count),
          "must not be negative");
  const Aim& aim = plan.aim;
  require(aim.edge_share >= 0.0 && aim.edge_share <= 1.0, "Plan",
          "edge_share = " + text_of(aim.edge_share), "must lie in [0, 1]");
  require(std::isfinite(aim.undetected_diameter_m) && aim.undetected_diameter_m >= 0.0, "Plan",
          "undetected_diameter = " + text_of(aim.undetected_diameter_m) + " m",
          "must be finite and not negative");
  require(aim.probability > 0.0 && aim.probability < 1.0, "Plan",
          "probability = " + text_of(aim.probability), "must lie in (0, 1)");
  require(plan.batches >= 0, "Plan", "batches = " + std::to_string(plan.batches),
          "must not be negative");
  check(plan.stop);
}

}  // namespace palpation
