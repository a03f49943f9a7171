// The gate's part of what is asked of a server.
#include <utility>

#include "palpation/base/error.h"
#include "palpation/io/csv.h"
#include "scene/gate_setup.h"
#include "scene/registration_file.h"
#include "scene/scene_json.h"
#include "tool/server.h"
#include "tool/server_run.h"
#include "tool/server_words.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

ArmPose pose_asked(Request& request) {
  return {request.number("stamp", 0.0), request.text("frame"), request.triple("position"),
          request.quadruple("quaternion")};
}

Phase phase_asked(Request& request) {
  const std::string word = request.text("phase");
  if (word == "air") return Phase::Air;
  if (word == "search") return Phase::Search;
  if (word == "press") return Phase::Press;
  if (word == "retract") return Phase::Retract;
  throw BadRequest("\"phase\" is " + shown(word) + ", but must be air, search, press or retract");
}

Verdict hear(Gate& gate, const std::string& what, Request& request, double now_s) {
  if (what == "pose") {
    const ArmPose pose = pose_asked(request);
    request.done();
    return gate.hear(pose, now_s);
  }
  if (what == "force") {
    const ArmForce force{request.number("stamp"), request.number("force")};
    request.done();
    return gate.hear(force, now_s);
  }
  if (what == "state") {
    const ArmCondition condition{request.number("stamp"), request.text("state"),
                                 request.truth("is_homed", false), request.truth("is_busy", false)};
    request.done();
    return gate.hear(condition, now_s);
  }
  const std::string words = request.text("words");
  request.done();
  return gate.hear_failure(words);
}

}  // namespace

Gate& Server::gate_of_run() {
  Run& now = run();
  if (!now.gate) {
    now.gate.emplace(gate_limits_of(now.scene, now.tissue.surface),
                     height_over(now.scene, now.tissue.surface));
    if (!held_for_.empty()) now.gate->hold_as_before(std::exchange(held_for_, ""));
  }
  return *now.gate;
}

/// A stop of the plan, as it was handed out: in the robot's frame.
GateStop Server::stop_asked(Request& request) {
  const int stop = request.whole("stop");
  request.done();
  const SessionState& state = run().session.state();
  if (state.plans.empty() || stop < 0 ||
      static_cast<std::size_t>(stop) >= state.plans.back().stops.size())
    throw BadRequest("\"stop\" is " + std::to_string(stop) + ", but must be one of the plan's");
  const CsvTable table = parse_csv(state.plans.back().plan.waypoints_csv, "waypoints");
  const auto triple = [&](const std::string& prefix) {
    const auto at = [&](const char* axis) {
      return finite_number_at(table, static_cast<std::size_t>(stop),
                              column_index(table, prefix + axis));
    };
    return Vec3(at("x"), at("y"), at("z"));
  };
  const Vec3 surface = triple("");
  return {surface, triple("normal_"), (triple("indented_") - surface).norm(),
          (triple("approach_") - surface).norm()};
}

json Server::gate(Request& request) {
  const std::string what = request.text("what");
  if (what == "limits") {
    request.done();
    json answer = limits_of_answer(gate_of_run().limits());
    answer["registration"] = registration_age(run().scene).words;
    return answer;
  }
  const double now_s = request.number("now");
  Gate& gate = gate_of_run();
  Verdict verdict;
  if (what == "pose" || what == "force" || what == "state" || what == "failure") {
    verdict = hear(gate, what, request, now_s);
  } else if (what == "begin") {
    verdict = gate.begin(stop_asked(request), now_s);
  } else if (what == "permit") {
    const Phase phase = phase_asked(request);
    const ArmPose set_point = pose_asked(request);
    request.done();
    verdict = gate.permit(phase, set_point, now_s);
  } else if (what == "watch" || what == "reading" || what == "finish") {
    request.done();
    verdict = what == "watch"     ? gate.watch(now_s)
              : what == "reading" ? gate.reading_allowed(now_s)
                                  : gate.finish(now_s);
  } else {
    throw BadRequest("\"what\" is " + shown(what) +
                     ", but must be limits, pose, force, state, failure, begin, permit, watch, "
                     "reading or finish");
  }
  json answer = verdict_of_answer(verdict);
  answer["touches"] = gate.is_touching();
  return answer;
}

json Server::acknowledge(Request& request) {
  const double now_s = request.number("now");
  request.done();
  return verdict_of_answer(gate_of_run().acknowledge(now_s));
}

}  // namespace palpation::tool
