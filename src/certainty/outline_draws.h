/// Outlines that are drawn from their posterior, and whether that is the same however one comes to
/// it.
#pragma once

#include <cstdint>
#include <vector>

#include "certainty/outline_start.h"
#include "certainty/outline_walk.h"

namespace palpation {

inline constexpr int kChains = 2;

struct OutlineDraws {
  std::vector<OutlineDraw> draws;  ///< of two chains, one after the other
  double disagreement = 0.0;       ///< as OutlinePosterior has it
};

/// So many, of chains that go on for longer where they do not agree.
OutlineDraws draws_from(const OutlineStart& start, int count, std::uint64_t seed);

}  // namespace palpation
