/// A session and a gate as answers.
#pragma once

#include <nlohmann/json.hpp>

#include "palpation/robot/gate.h"
#include "palpation/session/session_state.h"

namespace palpation::tool {

nlohmann::json state_of_session(const SessionState& state);
/// Its stops with what became of them, and every figure of waypoints.csv and path.csv.
nlohmann::json plan_of_answer(const HandedOut& plan);
/// Metres, newtons, seconds, in the robot's frame.
nlohmann::json limits_of_answer(const GateLimits& limits);
nlohmann::json verdict_of_answer(const Verdict& verdict);

}  // namespace palpation::tool
