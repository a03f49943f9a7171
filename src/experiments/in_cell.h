/// Of many cells, the one at which an error came up.
#pragma once

#include <string>

#include "palpation/base/error.h"

namespace palpation::tool {

/// What `act` returns; its errors begin with the cell's name and end the program as they would.
/// What is no matter of the cell (a disk that is full, an interrupt) passes as it is.
template <typename Act>
auto in_cell(const std::string& name, Act&& act) {
  const auto words = [&](const Error& error) { return "cell '" + name + "': " + error.what(); };
  try {
    return act();
  } catch (const WriteError&) {
    throw;
  } catch (const NumericalError& error) {
    throw NumericalError(words(error));
  } catch (const Error& error) {
    throw InvalidInput(words(error));
  }
}

}  // namespace palpation::tool
