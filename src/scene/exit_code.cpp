#include "scene/exit_code.h"

#include "palpation/base/error.h"
#include "scene/interrupt.h"

namespace palpation::tool {
namespace {

template <typename Kind>
bool is(const std::exception& error) {
  return dynamic_cast<const Kind*>(&error) != nullptr;
}

}  // namespace

ExitCode exit_code_of(const std::exception& error) {
  if (is<Interrupted>(error)) return kInterrupted;
  if (is<WrongUsage>(error)) return kWrongUsage;
  if (is<WriteError>(error) || is<NumericalError>(error)) return kMachineAtFault;
  return is<Error>(error) ? kInputAtFault : kMachineAtFault;
}

}  // namespace palpation::tool
