/// A small tissue, a planner that costs nothing, and a robot that says what it was told.
#pragma once

#include <memory>
#include <string>

#include "palpation/geometry/make_plane.h"
#include "palpation/session/session.h"
#include "session/journal.h"

namespace palpation {

/// 16 x 16 mm, nine vertices a side.
inline Surface small_tissue() {
  Random unused(0);
  return Surface(make_plane({.size_m = Vec2(0.016, 0.016), .columns = 9, .rows = 9}, unused));
}

inline constexpr int kStopsAPlan = 4;

inline int batches_in(const std::string& csv) {
  int most = -1;
  for (std::size_t at = csv.find('\n') + 1; at < csv.size(); at = csv.find('\n', at) + 1) {
    std::size_t cell = at;
    for (int i = 0; i < 5; ++i) cell = csv.find(',', cell) + 1;
    most = std::max(most, std::stoi(csv.substr(cell)));
  }
  return most + 1;
}

/// As many plans as asked for; stops that hang on every byte of the question.
inline SessionPlanner small_planner(const Surface& surface, int plans = 5) {
  return [surface, plans](const SessionQuestion& question) {
    SessionPlan plan;
    std::string all = question.measurements_csv;
    for (const KeepOut& ball : question.keep_out) all += std::to_string(ball.centre.x());
    if (batches_in(question.measurements_csv) < plans) {
      const std::string digits = checksum_of(all);
      int vertex = std::stoi(digits.substr(0, 4), nullptr, 16);
      plan.stops = question.touch_first;
      for (int i = 0; i < kStopsAPlan; ++i, vertex += 7)
        plan.stops.push_back(surface.vertex(vertex % surface.vertex_count()));
    } else {
      plan.stop_reason = "budget";
    }
    plan.waypoints_csv = "index,checksum\n0," + checksum_of(all) + "\n";
    return plan;
  };
}

inline SessionSetup small_setup(const Surface& surface, int plans = 5) {
  return {.surface = surface,
          .planner = small_planner(surface, plans),
          .identity = {"{\"plan\":{\"batch\":4}}", "square", "1"}};
}

/// What is felt at a stop.
inline SessionReading felt_at(const SessionState& state, int stop) {
  const HandedOut& plan = state.plans.back();
  const Vec3 place = plan.plan.stops[static_cast<std::size_t>(stop)];
  return {.place = place,
          .reading = 7.0 + 100.0 * place.x() + 0.01 * plan.number + 0.001 * stop,
          .t_s = plan.number * 10.0 + stop,
          .stop = stop};
}

}  // namespace palpation
