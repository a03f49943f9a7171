/// A shift that all positions have in common, as their heights above curved tissue tell it.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "palpation/geometry/surface.h"

namespace palpation {

struct CommonShift {
  Vec3 shift_m = Vec3::Zero();  ///< from where they were made to where they are said to be
  double sd_m = 0.0;            ///< of its length
};

/// With n the surface's normal at the closest point, a shift t lifts a position by about n.t above
/// the surface, beside a height that is the same for all, as by how deep a probe goes in. Of ways
/// along which normals are alike, as all are on a plane, nothing is told and nothing is shifted: on
/// tissue that is nearly flat the least turn would be a shift of millimetres, and on a sphere a
/// turn is one. Nothing where less than 1.5 mm or more than 5 mm are told, less than four standard
/// deviations, heights vary by less than 0.3 mm, or the shift explains less than half of that. A
/// place for each position.
std::optional<CommonShift> common_shift(const Surface& surface, std::span<const Vec3> positions,
                                        std::span<const SurfacePoint> places);

/// A plain sentence, of the file of this name.
std::string shift_words(const std::string& name, const CommonShift& shift);

}  // namespace palpation
