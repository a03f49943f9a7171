/// Dense recordings from files: what a robot once felt, as columns x,y,z [m] and reading.
#pragma once

#include <filesystem>

#include "palpation/world/recording.h"

namespace palpation {

/// Needs the columns x, y and reading; z is 0 where there is none; others are ignored. Rows whose
/// reading is "nan" or empty were not recorded and are dropped. Readings are at most 1e30 in size,
/// positions within 1000 m of the origin. Throws IoError with line, column, value and rule, and if
/// fewer than three readings are left.
RecordedReadings read_recording(const std::filesystem::path& path);

}  // namespace palpation
