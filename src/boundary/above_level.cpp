#include "boundary/above_level.h"

#include <algorithm>
#include <cmath>

#include "boundary/level_segments.h"
#include "palpation/base/error.h"

namespace palpation {

void require_field(const Surface& surface, const Field& field, double level,
                   const std::string& function) {
  require(field.size() == surface.vertex_count(), function,
          "a field of " + std::to_string(field.size()) + " values",
          "must have one for each of the " + std::to_string(surface.vertex_count()) + " vertices");
  for (int vertex = 0; vertex < field.size(); ++vertex) {
    if (std::isfinite(field[vertex])) continue;
    require(false, function,
            "the field's value " + text_of(field[vertex]) + " at vertex " + std::to_string(vertex),
            "must be finite");
  }
  require(std::isfinite(level), function, "the level " + text_of(level), "must be finite");
}

Vec3 above_level(const Surface& surface, const Field& field, double level, int face) {
  const Eigen::Vector3i triangle = surface.triangle(face);
  const Vec3 values(field[triangle[0]], field[triangle[1]], field[triangle[2]]);
  const double scale = safe_scale(std::max(values.cwiseAbs().maxCoeff(), std::abs(level)));
  Vec3 above;
  for (int corner = 0; corner < 3; ++corner)
    above[corner] = scaled_value(values[corner], level, scale) - scale * level;
  return above;
}

}  // namespace palpation
