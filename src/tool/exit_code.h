/// How the program ends.
#pragma once

#include <exception>

namespace palpation::tool {

enum ExitCode {
  kDone = 0,
  kWrongUsage = 2,
  kInputAtFault = 3,    ///< missing, unreadable or malformed: mesh, scene, CSV, boundary
  kMachineAtFault = 4,  ///< cannot write, out of memory; or the arithmetic failed
  kInterrupted = 130,
};

ExitCode exit_code_of(const std::exception& error);

}  // namespace palpation::tool
