#include "palpation/io/recording.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "palpation/base/error.h"
#include "palpation/io/csv.h"

namespace palpation {
namespace {

constexpr double kFarthest_m = 1000.0;  // from the origin: squares and products of coordinates must
                                        // stay exact enough to triangulate
constexpr double kGreatestReading = 1e30;
constexpr std::size_t kLeastReadings = 3;

/// Nothing where nothing was recorded.
std::optional<double> reading_at(const CsvTable& table, std::size_t row, std::size_t column) {
  const std::optional<double> reading = number_at(table, row, column);
  if (!reading || std::isnan(*reading)) return std::nullopt;
  if (std::abs(*reading) > kGreatestReading)
    fail_at_cell(table, row, column,
                 "must be at most 1e30 in size, or nan where nothing was recorded");
  return reading;
}

double coordinate_at(const CsvTable& table, std::size_t row,
                     const std::optional<std::size_t>& column) {
  if (!column) return 0.0;
  const double coordinate = finite_number_at(table, row, *column);
  if (std::abs(coordinate) <= kFarthest_m) return coordinate;
  fail_at_cell(table, row, *column, "must be within 1000 m of the origin: positions are metres");
}

}  // namespace

RecordedReadings read_recording(const std::filesystem::path& path) {
  const CsvTable table = read_csv(path);
  const std::size_t x = column_index(table, "x"), y = column_index(table, "y"),
                    reading = column_index(table, "reading");
  const std::optional<std::size_t> z = find_column(table, "z");
  RecordedReadings recording{Points(static_cast<Eigen::Index>(table.row_count()), 3),
                             Eigen::VectorXd(static_cast<Eigen::Index>(table.row_count()))};
  Eigen::Index count = 0;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    const Vec3 position(coordinate_at(table, row, x), coordinate_at(table, row, y),
                        coordinate_at(table, row, z));
    const std::optional<double> felt = reading_at(table, row, reading);
    if (!felt) continue;
    recording.positions.row(count) = position;
    recording.readings[count++] = *felt;
  }
  if (count == 0) throw IoError(table.name() + ": no row holds a reading");
  if (static_cast<std::size_t>(count) < kLeastReadings)
    throw IoError(table.name() + ": only " + std::to_string(count) +
                  (count == 1 ? " row holds" : " rows hold") +
                  " a reading; a recording has at least three, not all on one line");
  recording.positions.conservativeResize(count, 3);
  recording.readings.conservativeResize(count);
  return recording;
}

}  // namespace palpation
