/// The measurements that a person or a robot hands in, and that the tool hands out:
/// measurements.csv.
///
/// Columns: x,y,z [m], reading, noise_variance (empty: the field's noise), batch, kind (stop, way,
/// or missed: could not be touched, without a reading), tx,ty,tz (unit direction of travel, or
/// empty), set_aside (why the reading is not used, or empty). As input x,y,z,reading is enough;
/// unknown columns are kept (`foreign`). The order of rows is that in which they were made: batch
/// after batch, and the probe is where the last one was.
///
/// Each position goes to the closest point of the surface, from at most 5 mm above or below it and
/// 1 mm beside its border. Places within a nanometre of an earlier row's are that row's place:
/// readings there are repeats, and if they are without noise and differ, they contradict each
/// other. Rows that repeat an earlier one of their batch, place, reading and direction alike to
/// every digit, are set aside, unless places that were touched again mostly read otherwise.
/// Readings are at most 1e30 in size and, where they differ, do so by 1e-30 at least; a noise
/// variance is 0, or 1e-60 to 1e60: what is computed from these stays within the range of doubles.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "palpation/geometry/surface.h"
#include "palpation/io/csv.h"
#include "palpation/readings/palpation.h"

namespace palpation {

/// The columns of a measurements file that mean nothing here, as they are.
struct ForeignColumns {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;  ///< one a palpation, with a cell for each name
};

struct MeasurementsFile {
  std::vector<Palpation> palpations;  ///< one a row, in the order of the rows
  bool has_batches = false;           ///< there is a column that tells them
  int places = 0;                     ///< distinct ones, of the readings that are not set aside
  ForeignColumns foreign;             ///< such as a robot's own
  /// Plain sentences: positions more than 0.1 mm off the surface, places within a nanometre of
  /// others, copies, readings far from all others.
  std::vector<std::string> warnings;
};

/// A row whose column withdrawn is neither empty, 0, no nor false was taken back by a person: it is
/// set aside, with that word as its reason. Where a column reading_unit says what readings are in,
/// all agree. Column t may say when a reading was made, in seconds that rise within a session, and
/// session in which: rows of many lie in one file, and each may have a zero and a gain of its own
/// (Palpation::session).
struct MeasurementRules {
  bool empty_noise_is_none = false;   ///< the field has no noise, so that repeats must agree even
                                      ///< where a row does not say so
  bool leave_out_off_tissue = false;  ///< positions too far off the surface are left out with a
                                      ///< warning, in place of an error, unless all are
  std::string reading_unit{};         ///< what a column reading_unit must say; empty: anything
};

/// A table without rows is no error. Throws IoError, naming line, column, value and rule, for all
/// that the above does not allow.
MeasurementsFile read_measurements(const std::filesystem::path& path, const Surface& surface,
                                   const MeasurementRules& rules = {});
/// The same of a table that was read already, such as one by parse_csv.
MeasurementsFile measurements_of(const CsvTable& table, const Surface& surface,
                                 const MeasurementRules& rules = {});

/// The same columns as text, with the shortest digits that read back as the same doubles; behind
/// them foreign ones, if there are any. Throws InvalidInput unless these have a row a palpation.
std::string measurements_csv(const Surface& surface, std::span<const Palpation> palpations,
                             const ForeignColumns& foreign = {});

}  // namespace palpation
