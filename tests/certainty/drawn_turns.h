// Turns of a line, drawn one after the other and weighed: the law's slow twin.
#pragma once

#include <cmath>
#include <numbers>

#include "certainty/turn_law.h"
#include "palpation/base/random.h"

namespace palpation {

struct DrawnTurn {
  double off = 0.0;
  double log_weight = 0.0;  ///< Of C at it and, but for the first, B since the last, over what it
                            ///< was drawn by.
};

inline double log_cauchy(double off, const Turns& turns) {
  return std::log(TurnDensity(turns).at(off, 0.0) / std::numbers::pi);
}

// Nine of ten a side's, the others a corner's.
inline DrawnTurn turn_of_polygon(const Turns& turns, Random& random) {
  const double half_width = random.uniform() < 0.9 ? std::exp(turns.log_half_width) : 1.0;
  return {std::remainder(half_width * std::tan(std::numbers::pi * (random.uniform() - 0.5)),
                         2.0 * std::numbers::pi)};
}

inline DrawnTurn first_turn(const Turns& turns, Random& random) {
  if (turns.kind == LineKind::Polygonal) return turn_of_polygon(turns, random);
  return {std::exp(turns.log_half_width) * std::tan(std::numbers::pi * (random.uniform() - 0.5))};
}

// Near the last one as often as bends that are no corner's lead there, unless C is narrower than
// these; else as C has it.
inline DrawnTurn next_turn(double last, const Turns& turns, Random& random) {
  if (turns.kind == LineKind::Polygonal) return turn_of_polygon(turns, random);
  const double bend = std::exp(turns.log_bend), half_width = std::exp(turns.log_half_width),
               no_corner = bend * std::sqrt(2.0 * std::numbers::pi) *
                           std::exp(log_cauchy(last, turns)) * half_width / (half_width + bend),
               near_it = no_corner / (no_corner + TurnDensity(turns).of_bend(1.0));
  const double off =
      random.uniform() < near_it ? last + bend * random.normal() : first_turn(turns, random).off;
  const double z = (off - last) / bend,
               near = std::exp(-0.5 * z * z) / (bend * std::sqrt(2.0 * std::numbers::pi)),
               anywhere = std::exp(log_cauchy(off, turns));
  return {off, log_cauchy(off, turns) + std::log(TurnDensity(turns).of_bend(off - last)) -
                   std::log(std::lerp(anywhere, near, near_it))};
}

}  // namespace palpation
