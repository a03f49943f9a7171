/// Rows of measurements that do not count: off the tissue, or taken back; and whether all are in
/// one unit and in the order in which they were made.
#pragma once

#include <string>
#include <vector>

#include "palpation/geometry/surface.h"
#include "palpation/io/csv.h"
#include "palpation/io/measurements.h"

namespace palpation {

/// True for rows whose position lies too far off the surface, with a warning of how many and the
/// farthest. Throws IoError if all do, with what is wrong with the first.
std::vector<bool> rows_off_tissue(const CsvTable& table, const Surface& surface,
                                  std::vector<std::string>& warnings);

/// The columns that mean nothing here, of the rows that are on the tissue.
ForeignColumns foreign_columns(const CsvTable& table, const std::vector<bool>& is_off);

/// Why a row does not count: its own reason, or that a person has withdrawn it.
std::string set_aside_at(const CsvTable& table, std::size_t row);

/// Throws IoError where the column reading_unit names two, or another than `unit` (empty: any).
void check_reading_unit(const CsvTable& table, const std::string& unit);

/// A warning where the column t falls within a session, as in a file that was sorted by place: rows
/// count as made in their order. Another where it holds no numbers.
void tell_times(const CsvTable& table, std::vector<std::string>& warnings);

}  // namespace palpation
