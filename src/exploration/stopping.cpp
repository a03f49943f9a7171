#include "palpation/exploration/stopping.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/normal.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

/// Over as many batches as are looked at the expected error must have stood still: one alone may
/// have gone to the plateaus.
constexpr std::size_t kStill = kErrorsLookedAt - 1;

}  // namespace

void check(const StopRule& rule) {
  require(rule.error_m2 >= 0.0, "StopRule", "error_m2 = " + text_of(rule.error_m2),
          "must not be negative or NaN");
  require(rule.band_m >= 0.0, "StopRule", "band_m = " + text_of(rule.band_m),
          "must not be negative or NaN");
  require(rule.least_gain >= 0.0 && rule.least_gain <= 1.0, "StopRule",
          "least_gain = " + text_of(rule.least_gain), "must lie in [0, 1]");
}

double expected_error_after(const Surface& surface, const Belief& belief, const Certainty& now,
                            const Level& level, std::span<const int> vertices) {
  std::vector<Palpation> touches;
  for (const int vertex : vertices)
    touches.push_back({.where = surface.at_vertex(vertex), .reading = level.value});
  const Field before = belief.at_vertices().variance;
  const Field after = belief.condition_on(touches).at_vertices().variance;
  const double level_variance = level.stddev.value_or(0.0) * level.stddev.value_or(0.0);
  double error_m2 = 0.0;
  for (Eigen::Index vertex = 0; vertex < before.size(); ++vertex) {
    const double whole = before[vertex] + level_variance;
    const double left = std::min(after[vertex] + level_variance, whole);
    const double known = whole - left;
    const double ratio =
        known > 0.0 ? std::sqrt(left / known) : std::numeric_limits<double>::infinity();
    error_m2 += surface.vertex_areas()[vertex] * 2.0 * owens_t(now.score[vertex], ratio);
  }
  return error_m2;
}

bool gains_too_little(const StopRule& rule, std::span<const double> errors_m2, const Certainty& now,
                      const Surface& surface, const Belief& belief, const Level& level,
                      std::span<const int> next) {
  if (rule.least_gain == 0.0 || errors_m2.size() <= kStill || next.empty()) return false;
  const double here = errors_m2.back(), least = (1.0 - rule.least_gain);
  if (here < least * errors_m2[errors_m2.size() - 1 - kStill]) return false;
  double unchanged = 0.0;
  for (Eigen::Index vertex = 0; vertex < now.score.size(); ++vertex)
    unchanged += surface.vertex_areas()[vertex] * normal_probability(-std::abs(now.score[vertex]));
  return expected_error_after(surface, belief, now, level, next) >= least * unchanged;
}

}  // namespace palpation
