/// Points, triangles, lines and dots on their way into a VTP file, as plain values.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "palpation/base/types.h"
#include "palpation/io/coordinates.h"

namespace palpation {

struct VtpShape {
  std::vector<Vec3> points;  ///< metres
  std::vector<int> dots;     ///< points that are a cell each
  std::vector<std::vector<int>> lines;
  std::vector<std::array<int, 3>> triangles;
  /// One value a point.
  std::vector<std::pair<std::string, std::vector<double>>> point_fields;
  std::vector<std::pair<std::string, std::vector<std::string>>> point_texts;
  /// One value a cell: dots come first, then lines, then triangles.
  std::vector<std::pair<std::string, std::vector<double>>> cell_fields;
  std::vector<std::pair<std::string, std::vector<std::string>>> cell_texts;
};

/// The bytes of a VTP file with coordinates in that unit, which its field data name with the frame;
/// the first of the point fields is what programs colour by. Throws InvalidInput where an index is
/// none of a point or an array has another length, WriteError naming `name` where VTK fails.
std::string vtp_of(const std::string& name, const VtpShape& model, LengthUnit unit, Frame frame);

}  // namespace palpation
