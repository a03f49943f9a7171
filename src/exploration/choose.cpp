#include <algorithm>
#include <utility>

#include "exploration/batch_choice.h"
#include "exploration/search_goal.h"
#include "palpation/base/error.h"
#include "palpation/decision/tour.h"
#include "palpation/exploration/choice.h"
#include "palpation/geometry/distance.h"

namespace palpation {
namespace {

/// Less than any two vertices of tissue are apart: keeps a batch from touching one of them twice.
constexpr double kDistinct_m = 1e-12;

bool touches_once(const Conclusion& conclusion, const Reach& reach) {
  return reach.touch_once || conclusion.model.field.is_noiseless();
}

/// What may be touched now, rising.
std::vector<int> candidates_of(const Surface& surface, const Progress& progress, const Reach& reach,
                               bool touch_once) {
  std::vector<bool> allowed(static_cast<std::size_t>(surface.vertex_count()), !reach.vertices);
  for (const int vertex : reach.vertices.value_or(std::vector<int>())) {
    require(vertex >= 0 && vertex < surface.vertex_count(), "Reach",
            "vertex " + std::to_string(vertex), "is not on the surface");
    allowed[static_cast<std::size_t>(vertex)] = true;
  }
  for (const int vertex : touch_once ? progress.touched : progress.missed)
    allowed[static_cast<std::size_t>(vertex)] = false;
  std::vector<int> vertices;
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    if (allowed[static_cast<std::size_t>(vertex)]) vertices.push_back(vertex);
  }
  return vertices;
}

std::vector<int> in_tour_order(const Surface& surface, const std::vector<int>& stops,
                               const std::optional<SurfacePoint>& probe) {
  if (stops.empty()) return stops;
  std::vector<SurfacePoint> places = {
      probe ? *probe : surface.at_vertex(*std::min_element(stops.begin(), stops.end()))};
  for (const int stop : stops) places.push_back(surface.at_vertex(stop));
  Eigen::MatrixXd distance = distances_between(surface, places);
  // Between components the probe flies: those ways come last.
  const double farthest = surface.diameter() * static_cast<double>(surface.face_count());
  distance = distance.cwiseMin(farthest);
  std::vector<int> ordered;
  for (const int stop : shortest_tour(distance)) ordered.push_back(stops[stop]);
  return ordered;
}

bool gains_too_little(const Conclusion& conclusion, const Plan& plan, const Progress& progress,
                      std::span<const int> stops) {
  return conclusion.evidence.contrast_seen && conclusion.certainty &&
         gains_too_little(plan.stop, progress.expected_errors_m2, *conclusion.certainty,
                          conclusion.belief.prior().surface(), conclusion.belief, *conclusion.level,
                          stops);
}

/// Why nothing more is to be felt; empty while a disk that was to be found could still hide where
/// a touch may be made.
std::string enough_found(const Conclusion& conclusion, const Plan& plan,
                         std::span<const int> candidates) {
  std::string reason = enough_known(conclusion, plan.stop);
  if (reason.empty() || stops_to_goal(conclusion, plan.aim, candidates, 1).empty()) return reason;
  return "";
}

}  // namespace

Choice choose(const Surface& surface, const Conclusion& conclusion, const Plan& plan,
              const Progress& progress, const Reach& reach) {
  check(plan);
  const bool touch_once = touches_once(conclusion, reach);
  const std::vector<int> candidates = candidates_of(surface, progress, reach, touch_once);
  const bool is_first = progress.batches == 0 && plan.initial.count > 0;
  const int done = plan.initial.count > 0 ? progress.batches - 1 : progress.batches;
  std::vector<int> stops;
  if (is_first) {
    Random random(plan.initial.seed);
    stops = initial_design(surface, plan.initial.design, plan.initial.count, candidates, random);
  } else {
    if (done >= plan.batches) return {.stop_reason = "budget"};
    if (std::string reason = enough_found(conclusion, plan, candidates); !reason.empty())
      return {.stop_reason = std::move(reason)};
    BatchOptions options = plan.batch;
    options.from = progress.probe;
    if (touch_once && options.least_spacing_m == 0.0) options.least_spacing_m = kDistinct_m;
    stops = chosen_stops(conclusion, plan, done, candidates, options);
  }
  stops = in_tour_order(surface, stops, progress.probe);
  if (stops.empty()) return {.stop_reason = "nothing left to touch"};
  if (!is_first && gains_too_little(conclusion, plan, progress, stops))
    return {.stop_reason = "nothing to gain"};
  return {.stops = std::move(stops)};
}

std::string enough_known(const Conclusion& conclusion, const StopRule& rule) {
  const std::optional<Certainty>& certainty = conclusion.certainty;
  // Without a boundary nothing is known of how wrong it is: a level that no reading crosses is no
  // reason to rule.
  if (!conclusion.evidence.contrast_seen || !certainty || certainty->half_width_m == 0.0) return "";
  if (certainty->expected_in_all_m2() <= rule.error_m2 && rule.error_m2 > 0.0)
    return "expected error";
  if (certainty->half_width_m <= rule.band_m) return "band";
  return "";
}

Field acquisition_field(const Conclusion& conclusion, const Plan& plan) {
  return score(acquisition_in_force(conclusion, plan), conclusion.belief,
               conclusion.level.value_or(Level{}));
}

}  // namespace palpation
