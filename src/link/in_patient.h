/// From the scene's frame and the library's metres to what OpenIGTLink asks for: RAS, millimetres.
#pragma once

#include <Eigen/Core>
#include <string>

#include "link/messages.h"
#include "palpation/base/types.h"
#include "palpation/io/coordinates.h"

namespace palpation::link {

/// A half turn about z for LPS, else nothing.
Eigen::Matrix3d to_ras(Frame frame);
Vec3 ras_mm(const Vec3& place_m, Frame frame);

/// Words that fit in a STRING or STATUS: 60,000 bytes at most, cut between two characters of UTF-8.
std::string fitting(const std::string& words);
/// "OK", "UnknownError", ...
std::string name_of(Status status);

}  // namespace palpation::link
