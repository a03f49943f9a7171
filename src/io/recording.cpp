#include "palpation/io/recording.h"

#include <cmath>
#include <optional>

#include "palpation/base/error.h"
#include "palpation/io/csv.h"

namespace palpation {
namespace {

/// The rows that hold a reading.
std::vector<std::size_t> recorded_rows(const CsvTable& table, const std::vector<std::optional<double>>& readings) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < readings.size(); ++row) {
    if (!readings[row] || std::isnan(*readings[row])) continue;
    if (std::isinf(*readings[row]))
      fail_at_cell(table, static_cast<int>(row), "reading", "must be finite, or nan where nothing was recorded");
    rows.push_back(row);
  }
  if (rows.empty()) throw IoError(table.name + ": no row holds a reading");
  return rows;
}

}  // namespace

RecordedReadings read_recording(const std::filesystem::path& path) {
  const CsvTable table = read_csv(path);
  const std::vector<double> x = finite_numbers(table, "x"), y = finite_numbers(table, "y");
  const std::vector<double> z = find_column(table, "z") ? finite_numbers(table, "z") : std::vector<double>(x.size(), 0.0);
  const std::vector<std::optional<double>> readings = numbers(table, "reading");
  const std::vector<std::size_t> rows = recorded_rows(table, readings);
  RecordedReadings recording{Points(static_cast<Eigen::Index>(rows.size()), 3), Eigen::VectorXd(static_cast<Eigen::Index>(rows.size()))};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    recording.positions.row(index) << x[rows[i]], y[rows[i]], z[rows[i]];
    recording.readings[index] = *readings[rows[i]];
  }
  return recording;
}

}  // namespace palpation
