/// What changed between two times that a session was opened.
#pragma once

#include <string>

#include "palpation/session/session_state.h"

namespace palpation {

/// "the scene (probe/noise: 0.05 then, 0.1 now), the tissue"; empty where nothing differs.
std::string differences(const SessionIdentity& then, const SessionIdentity& now);

}  // namespace palpation
