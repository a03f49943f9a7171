#include "tool/server_words.h"

#include "palpation/io/csv.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

const char* word_of(StopState state) {
  if (state == StopState::Touched) return "touched";
  if (state == StopState::Missed) return "missed";
  return state == StopState::Open ? "open" : "dropped";
}

json list_of(const Vec3& place) { return {place.x(), place.y(), place.z()}; }

/// A row of waypoints.csv or path.csv, by the names of its columns.
json pose_of_row(const CsvTable& table, std::size_t row) {
  json pose;
  for (std::size_t column = 0; column < table.columns().size(); ++column)
    pose[table.columns()[column]] = finite_number_at(table, row, column);
  return pose;
}

}  // namespace

json state_of_session(const SessionState& state) {
  json withdrawn = json::array();
  for (std::size_t i = 0; i < state.rows.size(); ++i)
    if (!state.rows[i].withdrawn.empty()) withdrawn.push_back(i + 1);
  return {{"plans", state.plans.size()},
          {"rows", state.rows.size()},
          {"withdrawn", withdrawn},
          {"open", state.open_stops()},
          {"keep_out", state.keep_out.size()},
          {"touch_first", state.touch_first.size()}};
}

json plan_of_answer(const HandedOut& plan) {
  json answer{{"plan", plan.number}, {"batch", plan.batch}, {"used", plan.used}};
  json stops = json::array();
  const CsvTable table = parse_csv(plan.plan.waypoints_csv, "waypoints");
  for (std::size_t i = 0; i < plan.stops.size(); ++i) {
    const Vec3& place = plan.plan.stops[i];
    json stop = pose_of_row(table, i);
    stop["place"] = list_of(place);
    stop["state"] = word_of(plan.stops[i]);
    stop["index"] = i;
    stops.push_back(stop);
  }
  answer["stops"] = stops;
  answer["way"] = json::array();
  const CsvTable way = parse_csv(plan.plan.path_csv, "path");
  for (std::size_t i = 0; i < way.row_count(); ++i) answer["way"].push_back(pose_of_row(way, i));
  if (stops.empty()) answer["finished"] = plan.plan.stop_reason;
  return answer;
}

json limits_of_answer(const GateLimits& limits) {
  const ForceLimits& force = limits.force;
  const MotionLimits& motion = limits.motion;
  return {{"frame", limits.frame},
          {"box_least", list_of(limits.box_least)},
          {"box_most", list_of(limits.box_most)},
          {"contact_n", force.contact_n},
          {"warn_n", force.warn_n},
          {"hold_n", force.hold_n},
          {"air_m_per_s", motion.air_m_per_s},
          {"contact_m_per_s", motion.contact_m_per_s},
          {"turn_rad_per_s", motion.turn_rad_per_s},
          {"step_m", motion.step_m},
          {"settle_s", motion.settle_s},
          {"extra_indent_m", limits.extra_indent_m},
          {"uncertainty_m", limits.uncertainty_m},
          {"data_age_s", limits.data_age_s}};
}

json verdict_of_answer(const Verdict& verdict) {
  constexpr const char* kWords[] = {"go", "touches", "retract", "hold"};
  json answer{{"answer", kWords[static_cast<int>(verdict.answer)]}};
  if (!verdict.words.empty()) answer["words"] = verdict.words;
  return answer;
}

}  // namespace palpation::tool
