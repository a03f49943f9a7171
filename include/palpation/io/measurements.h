/// The measurements that a person or a robot hands in, and that the tool hands out: measurements.csv.
///
/// Columns: x,y,z [m], reading, noise_variance (empty: the field's noise), batch, kind (stop or way), tx,ty,tz (unit direction of travel,
/// or empty), set_aside (why the reading is not used, or empty). As input x,y,z,reading is enough; unknown columns are ignored.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "palpation/belief/palpation.h"
#include "palpation/geometry/surface.h"

namespace palpation {

struct MeasurementsFile {
  std::vector<Palpation> palpations;
  std::vector<std::string> warnings;  ///< one plain sentence where positions lay more than 0.1 mm off the surface
};

/// Each position goes to the closest point of the surface. A table without rows is no error. Throws IoError, naming line, column, value and
/// rule: for a position or reading that is not finite, a negative noise variance, and a position farther than 5 mm from the surface.
MeasurementsFile read_measurements(const std::filesystem::path& path, const Surface& surface);

/// The same columns as text, with the shortest digits that read back as the same doubles.
std::string measurements_csv(const Surface& surface, std::span<const Palpation> palpations);

}  // namespace palpation
