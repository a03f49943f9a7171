#include "exploration/field_fit.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace palpation {
namespace {

/// Mean and standard deviation of the readings, as BeliefOptions::standardize takes them.
struct Spread {
  double mean = 0.0;
  double sd = 1.0;
};

Spread spread_of(const std::vector<double>& readings) {
  Spread spread;
  double square = 0.0;
  for (double reading : readings) spread.mean += (reading - readings.front()) / static_cast<double>(readings.size());
  spread.mean += readings.front();
  for (double reading : readings) square += (reading - spread.mean) * (reading - spread.mean) / static_cast<double>(readings.size());
  if (square > 0.0) spread.sd = std::sqrt(square);
  return spread;
}

}  // namespace

Belief unlearned(const Surface& surface, const FieldModel& field) {
  Kernel kernel = field.kernel;
  if (field.learn_length) kernel.length_m = field.length_median_m;
  if (field.learn_signal) kernel.signal_sd = 1.0;
  BeliefOptions options = field.belief;
  if (field.learn_noise) options.noise_sd = 0.1 * kernel.signal_sd;
  if (field.learns()) options.standardize = options.noise_is_relative = false;
  return Belief(Prior(surface, field.metric, kernel, field.constant), options);
}

std::vector<double> used_readings(std::span<const Palpation> palpations) {
  std::vector<double> readings;
  for (const Palpation& palpation : palpations) {
    if (palpation.set_aside.empty()) readings.push_back(palpation.reading);
  }
  return readings;
}

bool all_equal(const std::vector<double>& readings) {
  return std::adjacent_find(readings.begin(), readings.end(), std::not_equal_to<>()) == readings.end();
}

FieldFit fit_field(const Surface& surface, const FieldModel& field, std::span<const Palpation> palpations, const Hyperparameters& start) {
  const Belief fresh = unlearned(surface, field);
  const std::vector<double> readings = used_readings(palpations);
  if (gather_sites(fresh.prior(), palpations).size() < 2 || all_equal(readings)) return {fresh.condition_on(palpations), start};
  LearnOptions options;
  options.length_median_m = field.length_median_m;
  if (!field.learn_length) options.length_m = field.kernel.length_m;
  if (!field.learn_signal) options.signal_sd = field.kernel.signal_sd;
  if (!field.learn_noise) options.noise_sd = field.belief.noise_sd;
  // A field of zero mean around the readings' mean, if they are standardized: what is learned is in reading units all the same.
  const bool centred = field.belief.standardize && field.constant.sd == 0.0;
  const Spread spread = centred ? spread_of(readings) : Spread{};
  std::vector<Palpation> shifted(palpations.begin(), palpations.end());
  for (Palpation& palpation : shifted) palpation.reading -= spread.mean;
  const Learned learned = learn(fresh.prior(), shifted, start, options);

  Kernel kernel = field.kernel;
  kernel.length_m = learned.values.length_m;
  kernel.signal_sd = learned.values.signal_sd / spread.sd;
  const Prior prior(surface, field.metric, kernel, field.constant);
  return {Belief(prior, {.noise_sd = learned.values.noise_sd, .standardize = centred}).condition_on(palpations), learned.values,
          learned.signal_evidence};
}

}  // namespace palpation
