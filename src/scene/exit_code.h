/// How the program ends.
#pragma once

#include <exception>
#include <stdexcept>

namespace palpation::tool {

enum ExitCode {
  kDone = 0,
  kWrongUsage = 2,
  kInputAtFault = 3,    ///< missing, unreadable or malformed: mesh, scene, CSV, boundary
  kMachineAtFault = 4,  ///< cannot write, out of memory; or the arithmetic failed
  kInterrupted = 130,
};

/// Options that contradict each other or themselves, which only their values tell.
struct WrongUsage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

ExitCode exit_code_of(const std::exception& error);

}  // namespace palpation::tool
