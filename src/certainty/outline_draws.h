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

struct ChainStarts {
  std::array<OutlineStart, kChains> of;
  /// Within an outline of the second chain, where the two are of two kinds: what encloses less is
  /// of the first one's, whatever it has besides.
  double least_area_m2 = 0.0;
  /// A chain of the second kind comes to be of the first one's though readings tell neither.
  bool is_left = false;

  bool are_alike() const {
    return of.front().profile.core.has_value() == of.back().profile.core.has_value();
  }
};

struct OutlineDraws {
  std::vector<OutlineDraw> draws;  ///< of two chains, one after the other
  double disagreement = 0.0;       ///< as OutlinePosterior has it

  bool do_agree() const { return disagreement < 1.0; }
};

/// So many, of chains that go on for longer where they do not agree: those of two kinds, with a
/// core and without, are not asked to. Of these the second, where its kind is left, begins anew
/// several times, and only what is of its kind is taken; else what is not is told to have no core.
OutlineDraws draws_from(const ChainStarts& starts, int count, std::uint64_t seed);

}  // namespace palpation
