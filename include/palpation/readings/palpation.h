/// One touch and what was felt.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

#include "palpation/geometry/surface_point.h"

namespace palpation {

enum class TouchKind {
  Stop,   ///< at a planned stop
  Way,    ///< on the way between two
  Missed  ///< a planned stop that could not be touched: it tells where not to go again, and nothing
          ///< else
};

/// What a reading tells of what was felt: that it is as much, but for noise; or, where the sensor's
/// range ended, that it is as much at least, or at most.
enum class Bound { None, AtLeast, AtMost };

struct Palpation {
  SurfacePoint where;
  double reading = 0.0;  ///< stiffness, in the sensor's own unit
  double noise_variance =
      std::numeric_limits<double>::quiet_NaN();  ///< of this reading, its unit squared; NaN: the
                                                 ///< field's noise
  int batch = 0;                                 ///< 0: the initial design
  TouchKind kind = TouchKind::Stop;
  Vec3 travel = Vec3::Zero();  ///< unit direction of travel, or zero if unknown
  std::string set_aside{};     ///< why the reading is not used; empty if it is
  int session = 0;             ///< in each the sensor may have a zero and a gain of its own
  Bound bound = Bound::None;   ///< found by `conclude`; what is given here does not count
  /// In the list that was made, where this one is shorter; else its place in this one. Of a mean
  /// that of the first.
  std::optional<std::size_t> number{};

  bool is_bound() const { return bound != Bound::None; }
};

/// Of a palpation: when.
struct Made {
  int batch = 0;
  std::size_t number = 0;  ///< readings that were made before it (Palpation::number)
  int session = 0;
  Bound bound = Bound::None;
  Vec3 travel = Vec3::Zero();  ///< Palpation::travel
};

inline Palpation missed_at(const SurfacePoint& where) {
  return {.where = where,
          .reading = std::numeric_limits<double>::quiet_NaN(),
          .kind = TouchKind::Missed};
}

/// Whether it is a reading, and one that is used.
inline bool counts(const Palpation& palpation) {
  return palpation.set_aside.empty() && palpation.kind != TouchKind::Missed;
}

}  // namespace palpation
