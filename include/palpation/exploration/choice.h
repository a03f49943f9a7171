/// Where to touch next, and why no more.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "palpation/exploration/conclusion.h"
#include "palpation/exploration/plan.h"

namespace palpation {

/// What of the readings' history a choice depends on.
struct Progress {
  int batches = 0;                      ///< made so far, the initial one included
  std::optional<SurfacePoint> probe{};  ///< where it is: at the last reading
  std::vector<int> touched{};           ///< vertices, rising, those that could not be touched too
  std::vector<int> missed{};            ///< of them, those that could not be touched
  /// Expected after each batch with a boundary, the last one now, m2; empty where the plan does not
  /// stop by it (StopRule::least_gain).
  std::vector<double> expected_errors_m2{};
};

/// What follows from readings that carry their batch and kind. `conclusion`: from all of them.
/// Where the plan stops by what batches gain, this concludes from the readings of earlier batches,
/// too; `before`, the progress without the last batch, spares that and changes nothing.
Progress progress_of(const Surface& surface, const Conclusion& conclusion, const Plan& plan,
                     std::span<const Palpation> readings, const Progress* before = nullptr);

struct Choice {
  std::vector<int> stops{};   ///< in the order of travel from where the probe is
  std::string stop_reason{};  ///< why there are none: "budget", "expected error", "band", "nothing
                              ///< to gain", "nothing left to touch"; empty while there are
};

/// First the initial design, then batches. Depends on the arguments alone. Throws InvalidInput as
/// check(Plan) says, and for a vertex in reach that is not on the surface.
Choice choose(const Surface& surface, const Conclusion& conclusion, const Plan& plan,
              const Progress& progress, const Reach& reach = {});

/// Whether enough is known: "expected error" or "band", as the rule asks for; else empty.
std::string enough_known(const Conclusion& conclusion, const StopRule& rule);

/// What the next batch maximizes, at the vertices.
Field acquisition_field(const Conclusion& conclusion, const Plan& plan);

}  // namespace palpation
