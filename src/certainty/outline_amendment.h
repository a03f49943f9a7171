/// What the loops of an outline do not have: a stadium that adds to the inside or takes from it.
///
/// Loops move, but none appears, vanishes, splits or joins another. A part that nobody has seen, a
/// hole, a neck that is cut or bridged is a stadium: the places within a radius of a segment. There
/// may be two, each as likely as not. One holds a reading, its anchor: of places without any the
/// readings tell nothing, and the search for tumours says what they may hide.
#pragma once

#include "certainty/outline_nodes.h"
#include "palpation/base/random.h"

namespace palpation {

struct Amendment {
  bool is_present = false;
  bool adds = true;
  int anchor = 0;  ///< of the readings; any of them, all as likely
  Vec2 anchor_place = Vec2::Zero();
  Vec2 offset = Vec2::Zero();  ///< of its middle from there, in radii: in the unit disk, uniform
  double log_radius = 0.0;     ///< of metres
  double half_length_m = 0.0;
  double angle = 0.0;
  double log_contrast = 0.0;  ///< of what it adds
  double wider_m = 0.0;       ///< of what it adds, as OutlineDraw has it

  /// Distance from its border, positive inside.
  double depth_at(const Vec2& place) const;
};

/// Of a present one's form; -infinity where it may not be.
double log_amendment_density(const Amendment& amendment);
/// From its prior but for the anchor.
Amendment drawn_amendment(int anchor, const Vec2& anchor_place, Random& random);

}  // namespace palpation
