/// One touch and what was felt.
#pragma once

#include <limits>
#include <string>

#include "palpation/geometry/surface_point.h"

namespace palpation {

enum class TouchKind { Stop, Way };  ///< at a planned stop, or on the way between two

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
};

}  // namespace palpation
