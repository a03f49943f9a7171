/// A file that cannot be read at all, whatever it holds.
#pragma once

#include "palpation/base/error.h"

namespace palpation {

class CannotRead : public IoError {
 public:
  using IoError::IoError;
};

}  // namespace palpation
