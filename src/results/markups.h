/// Places as 3D Slicer's markups: .mrk.json, by its schema v1.0.3.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "results/run.h"

namespace palpation::results {

struct Mark {
  std::string label;
  std::string description;
  Vec3 place = Vec3::Zero();  ///< metres
};

/// A list of points in millimetres, in that colour. Throws InvalidInput unless the frame is RAS or
/// LPS.
std::string markups_json(const std::string& name, const std::vector<Mark>& marks, Frame frame,
                         const std::array<double, 3>& colour);

}  // namespace palpation::results
