/// A field that the readings cannot have, by the arithmetic.
#pragma once

#include <string>

#include "palpation/base/error.h"

namespace palpation {

/// what() is "<step>: <reason>".
class FieldNotFitted : public NumericalError {
 public:
  FieldNotFitted(const std::string& step, const std::string& reason)
      : NumericalError(step + ": " + reason), reason_(reason) {}

  const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

}  // namespace palpation
