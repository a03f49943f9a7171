/// What readings say that the model of one outline, one profile and one sensor does not.
///
/// Each rival adds one term to the readings near their most probable explanation: y = model + h
/// theta, theta normal. With C the readings' covariance and r what is left of them,
/// the rival is weighed against none by its Bayes factor, the noise's scale integrated out,
///
///     (r' C^-1 r / r' (C + h S h')^-1 r)^(n/2) (1 + h' C^-1 h S)^(-1/2),
///
/// and a kind of misfit by the mean over its rivals: when it began, where it lies, what kind of
/// outline there is (edge_belief.h). Were the model
/// true, that mean would exceed 1 / a in a share a of all runs at most (Markov's inequality), so
/// what counts as surprising needs no constant but the rate of false alarms.
#pragma once

#include <optional>

#include "palpation/geometry/surface.h"

namespace palpation {

enum class MisfitKind {
  Zero,        ///< readings lie higher or lower from some batch on
  Gain,        ///< from some batch on what stands out does so by more or less
  WeakerPart,  ///< something stands out that the outline does not hold
};

/// Of a kind, the rival that explains the most.
struct Misfit {
  MisfitKind kind = MisfitKind::Zero;
  double evidence = 0.0;  ///< nats: logarithm of the kind's mean Bayes factor
  int from_batch = 0;     ///< Zero, Gain: the first batch that differs
  /// Zero: by how much, in readings. Gain: the factor, less one. WeakerPart: its height above the
  /// profile there, in readings.
  double amount = 0.0;
  std::optional<SurfacePoint> where{};  ///< WeakerPart
};

}  // namespace palpation
