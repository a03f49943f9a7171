/// What the loops of an outline may hold too much of: a stadium that takes from the inside.
///
/// Loops move, but none appears, vanishes or splits. A hole that nobody has seen, a notch, a neck
/// that is cut is a stadium: the places within a radius of a segment. There may be two, each as
/// likely as not. One holds a reading, its anchor: of places without any the readings tell nothing.
/// None adds to the inside: what stands out elsewhere is told and not cut out (edge_belief.h),
/// since the background of real tissue is not flat.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "certainty/stadium.h"
#include "palpation/base/random.h"

namespace palpation {

struct OutlineCut {
  bool is_present = false;
  int anchor = 0;  ///< of the readings; any of them, all as likely
  Vec2 anchor_place = Vec2::Zero();
  Vec2 offset = Vec2::Zero();  ///< of its middle from there, in radii: in the unit disk, uniform
  double log_radius = 0.0;     ///< of metres
  double half_length_m = 0.0;
  double angle = 0.0;

  Stadium stadium() const {
    const double radius = std::exp(log_radius);
    return stadium_about(anchor_place + radius * offset, radius, half_length_m, angle);
  }
};

inline constexpr int kCuts = 2;
using OutlineCuts = std::array<OutlineCut, kCuts>;

/// All that is taken.
struct TakenOut {
  OutlineCuts cuts;
  std::array<Stadium, kCuts> stadiums{};  ///< of the cuts that are present
  std::vector<double> anchors{};  ///< how often fresh cuts have these or earlier ones, rising to 1
};

/// Of a present one's form; -infinity where it may not be.
double log_cut_density(const OutlineCut& cut);
/// From its prior but for the anchor.
OutlineCut drawn_cut(int anchor, const Vec2& anchor_place, Random& random);

}  // namespace palpation
