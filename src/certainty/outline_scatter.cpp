#include "certainty/outline_scatter.h"

#include <cmath>
#include <limits>

namespace palpation {
namespace {

constexpr double kGrowth = 0.1, kMostGrowth = 2.3;

}  // namespace

double log_growth_density(double growth) {
  if (growth < 0.0 || growth > kMostGrowth) return -std::numeric_limits<double>::infinity();
  return -std::log1p(growth * growth / (kGrowth * kGrowth));
}

ReadingScatter scatter_of(const std::vector<double>& variance) {
  ReadingScatter scatter{.beforehand = variance, .variance = variance, .precision = {}};
  for (const double one : variance) scatter.precision.push_back(1.0 / one);
  return scatter;
}

void grow(ReadingScatter& scatter, const Eigen::VectorXd& log_sd) {
  for (std::size_t i = 0; i < scatter.variance.size(); ++i) {
    scatter.variance[i] =
        scatter.beforehand[i] * std::exp(2.0 * log_sd[static_cast<Eigen::Index>(i)]);
    if (scatter.precision[i] > 0.0) scatter.precision[i] = 1.0 / scatter.variance[i];
  }
}

}  // namespace palpation
