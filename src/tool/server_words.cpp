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
    json stop{{"place", {place.x(), place.y(), place.z()}}, {"state", word_of(plan.stops[i])}};
    for (std::size_t column = 0; column < table.columns().size(); ++column)
      stop[table.columns()[column]] = finite_number_at(table, i, column);
    stop["index"] = i;
    stops.push_back(stop);
  }
  answer["stops"] = stops;
  if (stops.empty()) answer["finished"] = plan.plan.stop_reason;
  return answer;
}

json verdict_of_answer(const Verdict& verdict) {
  constexpr const char* kWords[] = {"go", "touches", "retract", "hold"};
  json answer{{"answer", kWords[static_cast<int>(verdict.answer)]}};
  if (!verdict.words.empty()) answer["words"] = verdict.words;
  return answer;
}

}  // namespace palpation::tool
