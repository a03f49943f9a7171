/// Where to touch, as far as it is decided beforehand.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "palpation/decision/acquisition.h"
#include "palpation/decision/batch.h"
#include "palpation/decision/design.h"
#include "palpation/exploration/stopping.h"

namespace palpation {

/// The first batch, before anything is known.
struct InitialDesign {
  Design design = Design::Grid;
  int count = 16;
  std::uint64_t seed = 1;  ///< of what is random in the design
};

/// What batches are for.
struct Aim {
  /// The part of the batches that goes where it tells the most about the boundary (edge_belief.h),
  /// once one is seen and the level is inferred from its edge: half of it in the first batch, half
  /// as much again in the last. The rest goes where another tumour as large as the largest found
  /// could hide, until none could, and follows the acquisition then: with more than this a second,
  /// small tumour is missed.
  double edge_share = 0.65;
  /// Wherever a disk as wide as this could still hide, the rest goes first, and grows as far as the
  /// batches that are left need it; 0: no such goal, and the edge gives up nothing.
  double undetected_diameter_m = 0.0;
  double probability = 0.95;  ///< with which such a disk is to be found

  bool has_goal() const { return undetected_diameter_m > 0.0; }
};

struct Plan {
  Acquisition acquisition = straddle();
  InitialDesign initial{};
  BatchOptions batch{.least_spacing_m = 0.0005};
  int batches = 9;  ///< after the initial one
  Aim aim{};
  StopRule stop{};
};

/// Throws InvalidInput unless counts and the goal are not negative, the share is in [0, 1] and the
/// goal's probability between them, and as
/// check(StopRule).
void check(const Plan& plan);

/// What may be touched.
struct Reach {
  std::optional<std::vector<int>> vertices{};  ///< rising; nothing: all, which empty is not
  bool touch_once =
      false;  ///< a touched vertex is no candidate any more; so too where readings have no noise
};

}  // namespace palpation
