/// Readings of a session beside those of the sessions before it.
#pragma once

#include <span>
#include <vector>

#include "palpation/geometry/surface.h"
#include "palpation/readings/palpation.h"

namespace palpation {

/// Two that were made near each other.
struct ReadingPair {
  double own = 0.0;    ///< of the session
  double other = 0.0;  ///< of one before, and
  int session = 0;     ///< which
};

/// Each reading of a session with the nearest one of those before it, over the closer half. Those
/// that count alone.
std::vector<ReadingPair> pairs_of_session(const Surface& surface,
                                          std::span<const Palpation> palpations, int session);

/// The number of the first palpation of each session that counts, but of the first of these; by
/// rising session.
struct SessionStart {
  int session = 0;
  std::size_t number = 0;
};
std::vector<SessionStart> later_sessions(std::span<const Palpation> palpations);

}  // namespace palpation
