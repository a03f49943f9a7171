#include <algorithm>

#include "palpation/exploration/choice.h"

namespace palpation {
namespace {

void sort_unique(std::vector<int>& vertices) {
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

std::optional<double> expected_error_m2(const Conclusion& conclusion) {
  if (!conclusion.certainty) return std::nullopt;
  return conclusion.certainty->expected_in_all_m2();
}

/// As many as the stop rule looks back, the last one now; of batches that were made, whatever
/// their numbers are.
std::vector<double> expected_errors_m2(const Surface& surface, const Conclusion& conclusion,
                                       std::span<const Palpation> readings) {
  std::vector<double> backwards;
  if (const auto now = expected_error_m2(conclusion)) backwards.push_back(*now);
  std::vector<Palpation> earlier(readings.begin(), readings.end());
  const auto forget_last_batch = [&] {
    if (earlier.empty()) return false;
    const int last = std::ranges::max_element(earlier, {}, &Palpation::batch)->batch;
    std::erase_if(earlier, [&](const Palpation& one) { return one.batch == last; });
    return !earlier.empty();
  };
  while (backwards.size() < kErrorsLookedAt && forget_last_batch()) {
    const auto then = expected_error_m2(conclude(surface, conclusion.model, earlier));
    if (then) backwards.push_back(*then);
  }
  return {backwards.rbegin(), backwards.rend()};
}

}  // namespace

Progress progress_of(const Surface& surface, const Conclusion& conclusion, const Plan& plan,
                     std::span<const Palpation> readings, const Progress* before) {
  Progress progress;
  for (const Palpation& reading : readings) {
    progress.batches = std::max(progress.batches, reading.batch + 1);
    const int vertex = surface.vertex_at(reading.where);
    if (vertex < 0) continue;
    progress.touched.push_back(vertex);
    if (reading.kind == TouchKind::Missed) progress.missed.push_back(vertex);
  }
  const auto felt = std::find_if(readings.rbegin(), readings.rend(), [](const Palpation& one) {
    return one.kind != TouchKind::Missed;
  });
  sort_unique(progress.touched);
  sort_unique(progress.missed);
  if (felt != readings.rend()) progress.probe = felt->where;
  if (plan.stop.least_gain == 0.0) return progress;
  if (before != nullptr && before->batches == progress.batches - 1) {
    progress.expected_errors_m2 = before->expected_errors_m2;
    if (const auto now = expected_error_m2(conclusion)) progress.expected_errors_m2.push_back(*now);
  } else {
    progress.expected_errors_m2 = expected_errors_m2(surface, conclusion, readings);
  }
  return progress;
}

}  // namespace palpation
