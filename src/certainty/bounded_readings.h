/// Readings at the end of the sensor's range: what was felt is as much at least, or at most.
///
/// How far such a reading is off, which nobody knows, is one of the unknown (Tanner and Wong 1987):
/// normal, about what the background leaves, wherever that lets the tissue be what was told or
/// beyond. A profile is possible where it does so, too, and all such are as probable: so a plateau
/// beyond the sensor's range moves freely, whatever the noise is.
#pragma once

#include "palpation/base/random.h"
#include "palpation/readings/palpation.h"

namespace palpation {

/// Standard normal, of the numbers that are as large at least.
double normal_beyond(double least, Random& random);

/// What was told, less what a profile says.
struct ToldAtEnd {
  Bound bound = Bound::AtLeast;
  double off = 0.0;

  /// What was felt may be so far off the profile.
  bool allows(double felt_off) const;
  /// How probable it is, where noise of this standard deviation is about there.
  double probability(double about, double sd) const;
  /// How far what was felt is off, then.
  double drawn(double about, double sd, Random& random) const;

 private:
  double sign() const { return bound == Bound::AtLeast ? 1.0 : -1.0; }
  /// Standard deviations from there to what was told; positive if that is beyond.
  double steps_from(double about, double sd) const { return sign() * (off - about) / sd; }
};

}  // namespace palpation
