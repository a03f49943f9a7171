#include "experiments/intervals.h"

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>
#include <string>

#include "palpation/base/error.h"

namespace palpation::tool {
namespace {

void check(double confidence) {
  require(confidence > 0.0 && confidence < 1.0, "interval", "confidence = " + text_of(confidence),
          "must lie in (0, 1)");
}

}  // namespace

Interval wilson_interval(int hits, int trials, double confidence) {
  check(confidence);
  require(trials > 0, "wilson_interval", "trials = " + std::to_string(trials), "must be positive");
  require(hits >= 0 && hits <= trials, "wilson_interval", "hits = " + std::to_string(hits),
          "must lie between 0 and the trials");
  const double n = trials, share = hits / n;
  const double z = boost::math::quantile(boost::math::normal(), 0.5 + 0.5 * confidence);
  const double middle = (share + z * z / (2.0 * n)) / (1.0 + z * z / n);
  const double half =
      z / (1.0 + z * z / n) * std::sqrt(share * (1.0 - share) / n + z * z / (4.0 * n * n));
  // At the ends the formula gives 0 and 1 but for rounding.
  return {hits == 0 ? 0.0 : middle - half, hits == trials ? 1.0 : middle + half};
}

std::optional<Interval> mean_interval(std::span<const double> values, double confidence) {
  check(confidence);
  const double n = static_cast<double>(values.size());
  if (values.size() < 2) return std::nullopt;
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double square = 0.0;
  for (const double value : values) square += (value - mean) * (value - mean);
  const double t = boost::math::quantile(boost::math::students_t(n - 1.0), 0.5 + 0.5 * confidence);
  const double half = t * std::sqrt(square / (n - 1.0) / n);
  return Interval{mean - half, mean + half};
}

}  // namespace palpation::tool
