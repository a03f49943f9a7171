/// A sensor that fails as real ones do: what is felt, as it is reported.
#pragma once

#include "palpation/base/random.h"
#include "palpation/geometry/surface.h"
#include "palpation/readings/palpation.h"

namespace palpation {

/// Tissue that goes to and fro, as a sine of the readings that were made.
struct Breath {
  Vec3 by_m = Vec3::Zero();  ///< at most, to either side
  double readings = 4.0;     ///< from one time that it lies there to the next
  double phase = 0.0;        ///< radians, at the first reading
};

/// Parts are of all readings, each struck by itself. Ranges are in units of the contrast, high -
/// low.
struct SensorFaults {
  double lost = 0.0;         ///< part that lost contact: they read zero
  double wild = 0.0;         ///< part that may be anything ...
  double wild_ranges = 5.0;  ///< ... within so many ranges of the middle
  double jammed = 0.0;       ///< part that repeats the reading before
  double drift = 0.0;        ///< ranges that the zero moves in a hundred readings
  Breath breath{};           ///< of the tissue
};

/// Something that changes once and for all, as when a sensor is fastened anew or the tissue slips.
struct SensorChange {
  int after_stops = 0;  ///< whatever is felt on the way; 0: never
  double zero = 0.0;    ///< ranges that are added from then on
  double gain = 1.0;    ///< of what is felt above the low plateau
  Vec3 moved_m =
      Vec3::Zero();  ///< the tissue: where the probe is said to be, it feels what was here from it
};

class FaultySensor {
 public:
  /// Throws InvalidInput unless parts lie in [0, 1], all is finite, and low < high.
  FaultySensor(const SensorFaults& faults, const SensorChange& change, double low, double high);

  /// Where the probe feels, when it is believed to be here.
  SurfacePoint feels_at(const Surface& surface, const SurfacePoint& where) const;
  /// What is reported of a reading. Draws as many numbers whatever strikes.
  double reported(double reading, Random& random, TouchKind kind = TouchKind::Stop);

 private:
  bool has_changed() const { return change_.after_stops > 0 && stops_ >= change_.after_stops; }

  SensorFaults faults_;
  SensorChange change_;
  double low_;
  double range_;
  double last_;
  int readings_ = 0;
  int stops_ = 0;
};

}  // namespace palpation
