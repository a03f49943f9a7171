#include "session/entries.h"

#include <cmath>
#include <limits>

#include "palpation/base/error.h"

namespace palpation {
namespace {

using nlohmann::json;

constexpr int kFormat = 1;

json triple(const Vec3& point) { return json{point.x(), point.y(), point.z()}; }

Vec3 point_of(const json& triple) {
  return Vec3(triple.at(0).get<double>(), triple.at(1).get<double>(), triple.at(2).get<double>());
}

/// JSON has no NaN.
json number_or_null(double value) { return std::isnan(value) ? json() : json(value); }

double number_of(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

bool is_in(const KeepOut& ball, const Vec3& place) {
  return (place - ball.centre).norm() <= ball.radius_m;
}

SessionRow row_of(const SessionState& state) {
  SessionRow row;
  if (state.plans.empty()) return row;
  row.plan = state.plans.back().number;
  row.batch = state.plans.back().batch;
  return row;
}

void apply_reading(SessionState& state, const json& entry) {
  SessionRow row = row_of(state);
  row.made = {.place = point_of(entry.at("place")),
              .reading = entry.at("reading").get<double>(),
              .noise_variance = number_of(entry.at("noise_variance")),
              .kind = entry.at("touch") == "way" ? TouchKind::Way : TouchKind::Stop,
              .travel = point_of(entry.at("travel"))};
  if (!entry.at("t").is_null()) row.made.t_s = entry.at("t").get<double>();
  row.off_tissue = entry.at("off_tissue").get<std::string>();
  if (!entry.at("stop").is_null()) {
    const int stop = entry.at("stop").get<int>();
    row.made.stop = stop;
    if (row.off_tissue.empty())
      state.plans.back().stops.at(static_cast<std::size_t>(stop)) = StopState::Touched;
  }
  state.rows.push_back(std::move(row));
}

void miss(SessionState& state, std::size_t stop, const std::string& why) {
  HandedOut& plan = state.plans.back();
  plan.stops.at(stop) = StopState::Missed;
  SessionRow row = row_of(state);
  row.made.place = plan.plan.stops.at(stop);
  row.made.kind = TouchKind::Missed;
  row.made.stop = static_cast<int>(stop);
  row.why = why;
  state.rows.push_back(std::move(row));
}

void apply_plan(SessionState& state, const json& entry) {
  HandedOut plan{.number = entry.at("plan").get<int>(),
                 .batch = entry.at("batch").get<int>(),
                 .plan = {.stop_reason = entry.at("stop_reason").get<std::string>(),
                          .waypoints_csv = entry.at("waypoints").get<std::string>(),
                          .path_csv = entry.at("path").get<std::string>()},
                 .used = entry.at("used").get<std::string>()};
  for (const json& stop : entry.at("stops")) plan.plan.stops.push_back(point_of(stop));
  plan.stops.assign(plan.plan.stops.size(), StopState::Open);
  state.plans.push_back(std::move(plan));
  state.touch_first.clear();
}

void apply_keep_out(SessionState& state, const json& entry) {
  const KeepOut ball{point_of(entry.at("centre")), entry.at("radius_m").get<double>()};
  state.keep_out.push_back(ball);
  std::erase_if(state.touch_first, [&](const Vec3& place) { return is_in(ball, place); });
  for (const int stop : state.open_stops()) {
    if (is_in(ball, state.plans.back().plan.stops[static_cast<std::size_t>(stop)]))
      miss(state, static_cast<std::size_t>(stop), "kept out");
  }
}

void apply_identity(SessionState& state, const json& entry) {
  if (entry.contains("format") && entry.at("format") != kFormat)
    throw InvalidInput("is of a newer version of palpation: this one reads format 1");
  state.identity = {entry.at("scene").get<std::string>(), entry.at("tissue").get<std::string>(),
                    entry.at("version").get<std::string>()};
  if (!entry.value("replans", false)) return;
  for (const int stop : state.open_stops())
    state.plans.back().stops[static_cast<std::size_t>(stop)] = StopState::Dropped;
  state.has_news = true;
}

json words_of(const SessionIdentity& identity, const char* kind) {
  return {{"kind", kind},
          {"scene", identity.scene},
          {"tissue", identity.tissue},
          {"version", identity.version}};
}

void apply_known(SessionState& state, const json& entry) {
  const std::string kind = entry.at("kind").get<std::string>();
  if (kind == "session" || kind == "changed") return apply_identity(state, entry);
  if (kind == "refused") return state.refusals.push_back(entry.at("words").get<std::string>());
  state.has_news = kind != "plan";
  if (kind == "plan")
    apply_plan(state, entry);
  else if (kind == "reading")
    apply_reading(state, entry);
  else if (kind == "missed")
    miss(state, entry.at("stop").get<std::size_t>(), entry.at("why").get<std::string>());
  else if (kind == "withdrawn")
    state.rows.at(entry.at("number").get<std::size_t>() - 1).withdrawn =
        entry.at("why").get<std::string>();
  else if (kind == "touch")
    state.touch_first.push_back(point_of(entry.at("place")));
  else if (kind == "keep-out")
    apply_keep_out(state, entry);
  else
    throw InvalidInput("is of a kind that this version does not know: " + kind);
}

}  // namespace

json first_entry(const SessionIdentity& identity) {
  json entry = words_of(identity, "session");
  entry["format"] = kFormat;
  return entry;
}

json change_entry(const SessionIdentity& identity, bool replans) {
  json entry = words_of(identity, "changed");
  entry["replans"] = replans;
  return entry;
}

json plan_entry(const HandedOut& plan, const std::string& measurements) {
  json stops = json::array();
  for (const Vec3& stop : plan.plan.stops) stops.push_back(triple(stop));
  return {{"kind", "plan"},
          {"plan", plan.number},
          {"batch", plan.batch},
          {"used", plan.used},
          {"measurements", measurements},
          {"stops", stops},
          {"stop_reason", plan.plan.stop_reason},
          {"waypoints", plan.plan.waypoints_csv},
          {"path", plan.plan.path_csv}};
}

json reading_entry(const SessionReading& reading, std::optional<int> stop,
                   const std::string& off_tissue) {
  return {{"kind", "reading"},
          {"place", triple(reading.place)},
          {"reading", reading.reading},
          {"noise_variance", number_or_null(reading.noise_variance)},
          {"touch", reading.kind == TouchKind::Way ? "way" : "stop"},
          {"travel", triple(reading.travel)},
          {"t", reading.t_s ? json(*reading.t_s) : json()},
          {"stop", stop ? json(*stop) : json()},
          {"off_tissue", off_tissue}};
}

json missed_entry(int stop, const std::string& why) {
  return {{"kind", "missed"}, {"stop", stop}, {"why", why}};
}

json withdrawn_entry(int number, const std::string& why) {
  return {{"kind", "withdrawn"}, {"number", number}, {"why", why}};
}

json touch_entry(const Vec3& place) { return {{"kind", "touch"}, {"place", triple(place)}}; }

json keep_out_entry(const KeepOut& ball) {
  return {{"kind", "keep-out"}, {"centre", triple(ball.centre)}, {"radius_m", ball.radius_m}};
}

json refusal_entry(const std::string& words) { return {{"kind", "refused"}, {"words", words}}; }

void apply(SessionState& state, const json& entry, const std::string& name) {
  const auto refuse = [&](const std::string& words) {
    throw IoError(name + ":" + entry.value("line", json("?")).dump() + ": this line " + words);
  };
  try {
    apply_known(state, entry);
  } catch (const InvalidInput& error) {
    refuse(error.what());
  } catch (const std::exception&) {
    refuse("does not fit the ones before it: it was written by another program");
  }
}

int plan_number_of(const json& entry) {
  const bool is_plan = entry.value("kind", "") == "plan";
  return is_plan ? entry.value("plan", -1) : -1;
}

std::string rows_used(const SessionState& state) {
  std::string used;
  for (std::size_t i = 0; i < state.rows.size(); ++i) {
    const auto counts = [&](std::size_t row) {
      return state.rows[row].off_tissue.empty() && state.rows[row].withdrawn.empty();
    };
    if (!counts(i)) continue;
    std::size_t last = i;
    while (last + 1 < state.rows.size() && counts(last + 1)) ++last;
    used += (used.empty() ? "" : ",") + std::to_string(i + 1);
    if (last > i) used += "-" + std::to_string(last + 1);
    i = last;
  }
  return used;
}

int next_batch(const SessionState& state) {
  int batch = 0;
  for (const SessionRow& row : state.rows) {
    if (row.off_tissue.empty()) batch = std::max(batch, row.batch + 1);
  }
  return batch;
}

}  // namespace palpation
