/// Outlines that are drawn from their posterior, and whether that is the same however one comes to
/// it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "certainty/outline_start.h"
#include "certainty/outline_walk.h"
#include "palpation/certainty/outline_posterior.h"

namespace palpation {

inline constexpr int kChains = 2;

struct ChainStarts {
  std::array<OutlineStart, kChains> of;
  /// Within an outline of the second chain, where the two are of two kinds: what encloses less is
  /// of the first one's, whatever it has besides.
  double least_area_m2 = 0.0;
  /// Of the second chain's kind, where the two are of two: its share of the draws.
  double probability = 0.5;

  bool are_alike() const {
    return of.front().profile.core.has_value() == of.back().profile.core.has_value();
  }
};

struct OutlineDraws {
  /// Two halves, which know nothing of each other: of each kind a chain's.
  std::vector<OutlineDraw> draws;
  OutlineMisfit misfit{};
};

/// So many, of chains that go on until they are alike; with a core, where some have none, for as
/// long as is sure. A chain that begins with one may come to be of those that have none: what has
/// is told to have none. Where that tells nothing, because without a core tissue rises up to its
/// middle, and bends follow two heights, it begins anew several times instead, and only what is of
/// its kind is taken.
OutlineDraws draws_from(const ChainStarts& starts, int count, std::uint64_t seed);

}  // namespace palpation
