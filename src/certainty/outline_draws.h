/// Outlines that are drawn from their posterior, and whether that is the same however one comes to
/// it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "certainty/outline_start.h"
#include "certainty/outline_walk.h"

namespace palpation {

inline constexpr int kChains = 2;

using ChainStarts = std::array<OutlineStart, kChains>;

struct OutlineDraws {
  std::vector<OutlineDraw> draws;  ///< of two chains, one after the other
  double disagreement = 0.0;       ///< as OutlinePosterior has it

  bool do_agree() const { return disagreement < 1.0; }
};

/// So many, of chains that go on for longer where they do not agree: those of two kinds, with a
/// core and without, are not asked to.
OutlineDraws draws_from(const ChainStarts& starts, int count, std::uint64_t seed);

}  // namespace palpation
