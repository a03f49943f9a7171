/// Where tissue becomes tumour, in reading units, and how sure that is.
#pragma once

#include <optional>

namespace palpation {

struct Level {
  double value = 0.0;
  std::optional<double> stddev;  ///< none where it is not known
};

}  // namespace palpation
