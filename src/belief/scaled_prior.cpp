#include "belief/scaled_prior.h"

#include <cmath>

#include "palpation/base/error.h"
#include "readings/readings.h"

namespace palpation {
namespace {

double mean_of(const Eigen::VectorXd& values) {
  const double origin = values[0];
  return origin + (values.array() - origin).sum() / static_cast<double>(values.size());
}

}  // namespace

double ScaledPrior::noise_variance() const {
  const double sd = options.noise_is_relative ? options.noise_sd * signal_sd() : options.noise_sd;
  return sd * sd;
}

double ScaledPrior::origin(std::span<const Site> sites) const {
  const bool has_constant = options.standardize || prior.constant().sd > 0.0;
  return has_constant && !sites.empty() ? merge(sites.front(), noise_variance()).mean : 0.0;
}

void ScaledPrior::standardize(std::span<const Palpation> palpations) {
  if (!options.standardize) return;
  const std::vector<double> used = used_readings(palpations);
  if (used.empty()) return;
  const Eigen::Map<const Eigen::VectorXd> readings(used.data(), std::ssize(used));
  centre = mean_of(readings);
  const double sd = std::sqrt((readings.array() - centre).square().mean());
  require(
      (sd > 1e-150 && sd < 1e150) || readings.minCoeff() == readings.maxCoeff(), "Belief",
      "readings between " + text_of(readings.minCoeff()) + " and " + text_of(readings.maxCoeff()),
      "cannot be standardized: the square of their spread must be a number");
  spread = sd > 0.0 ? sd : 1.0;
}

}  // namespace palpation
