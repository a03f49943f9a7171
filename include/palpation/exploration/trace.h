/// How a run went: one row per batch.
#pragma once

#include <optional>
#include <vector>

#include "palpation/boundary/region_error.h"

namespace palpation {

struct TraceRow {
  int batch = 0;
  int measurements = 0;
  double path_m = 0.0;  ///< travelled so far
  std::optional<double> level;
  std::optional<double> expected_error_m2;
  std::optional<RegionError> error;  ///< where the truth is known
};

using Trace = std::vector<TraceRow>;

}  // namespace palpation
