#include "palpation/exploration/stopping.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "palpation/base/error.h"

namespace palpation {
namespace {

/// Batches over which the expected error must have stood still: one alone may have gone to the plateaus.
constexpr std::size_t kStill = 3;

double upper_tail(double x) { return 0.5 * std::erfc(x / std::numbers::sqrt2); }

/// Gauss and Legendre's rule of ten points on [0, a], a <= 1.
double owens_integral(double h, double a) {
  constexpr std::array kNodes = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244, 0.8650633666889845, 0.9739065285171717};
  constexpr std::array kWeights = {0.2955242247147529, 0.2692667193099963, 0.2190863625159820, 0.1494513491505806, 0.0666713443086881};
  double sum = 0.0;
  for (std::size_t i = 0; i < kNodes.size(); ++i) {
    for (const double side : {-1.0, 1.0}) {
      const double x = 0.5 * a * (1.0 + side * kNodes[i]);
      sum += kWeights[i] * std::exp(-0.5 * h * h * (1.0 + x * x)) / (1.0 + x * x);
    }
  }
  return 0.5 * a * sum / (2.0 * std::numbers::pi);
}

}  // namespace

void check(const StopRule& rule) {
  require(rule.error_m2 >= 0.0, "StopRule", "error_m2 = " + text_of(rule.error_m2), "must not be negative or NaN");
  require(rule.band_m >= 0.0, "StopRule", "band_m = " + text_of(rule.band_m), "must not be negative or NaN");
  require(rule.least_gain >= 0.0 && rule.least_gain <= 1.0, "StopRule", "least_gain = " + text_of(rule.least_gain), "must lie in [0, 1]");
  require(rule.band_probability > 0.0 && rule.band_probability < 1.0, "StopRule", "band_probability = " + text_of(rule.band_probability),
          "must lie in (0, 1)");
}

double owens_t(double h, double a) {
  h = std::abs(h);
  if (a < 0.0) return -owens_t(h, -a);
  if (std::isinf(a)) return 0.5 * upper_tail(h);
  if (a <= 1.0) return owens_integral(h, a);
  const double p = upper_tail(h), q = upper_tail(a * h);
  return 0.5 * (p + q) - p * q - owens_integral(a * h, 1.0 / a);
}

double expected_error_after(const Surface& surface, const Belief& belief, const Certainty& now, const Level& level,
                            std::span<const int> vertices) {
  std::vector<Palpation> touches;
  for (const int vertex : vertices) touches.push_back({.where = surface.at_vertex(vertex), .reading = level.value});
  const Field before = belief.at_vertices().variance;
  const Field after = belief.condition_on(touches).at_vertices().variance;
  const double level_variance = level.stddev.value_or(0.0) * level.stddev.value_or(0.0);
  double error_m2 = 0.0;
  for (Eigen::Index vertex = 0; vertex < before.size(); ++vertex) {
    const double whole = before[vertex] + level_variance;
    const double left = std::min(after[vertex] + level_variance, whole);
    const double known = whole - left;
    const double ratio = known > 0.0 ? std::sqrt(left / known) : std::numeric_limits<double>::infinity();
    error_m2 += surface.vertex_areas()[vertex] * 2.0 * owens_t(now.score[vertex], ratio);
  }
  return error_m2;
}

bool gains_too_little(const StopRule& rule, std::span<const double> errors_m2, const Certainty& now, const Surface& surface,
                      const Belief& belief, const Level& level, std::span<const int> next) {
  if (rule.least_gain == 0.0 || errors_m2.size() <= kStill || next.empty()) return false;
  const double here = errors_m2.back(), least = (1.0 - rule.least_gain);
  if (here < least * errors_m2[errors_m2.size() - 1 - kStill]) return false;
  double unchanged = 0.0;
  for (Eigen::Index vertex = 0; vertex < now.score.size(); ++vertex)
    unchanged += surface.vertex_areas()[vertex] * upper_tail(std::abs(now.score[vertex]));
  return expected_error_after(surface, belief, now, level, next) >= least * unchanged;
}

}  // namespace palpation
