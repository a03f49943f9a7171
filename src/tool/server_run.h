/// What a server has open.
#pragma once

#include <optional>

#include "palpation/robot/gate.h"
#include "palpation/session/session.h"
#include "scene/tissue.h"
#include "tool/server.h"

namespace palpation::tool {

struct Server::Run {
  Scene scene;
  Tissue tissue;
  Session session;
  std::optional<Gate> gate;  ///< made when it is first asked
};

}  // namespace palpation::tool
