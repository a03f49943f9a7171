#include "palpation/io/measurements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "io/number_text.h"
#include "palpation/base/error.h"
#include "palpation/io/csv.h"

namespace palpation {
namespace {

constexpr double kFarthest = 0.005;
constexpr double kUnremarkable = 0.0001;

using Cells = std::vector<std::optional<double>>;

/// A column that may be missing: then all its cells are empty.
Cells optional_numbers(const CsvTable& table, std::string_view column) {
  return find_column(table, column) ? numbers(table, column) : Cells(table.rows.size());
}

std::string word_at(const CsvTable& table, std::size_t row, std::string_view column) {
  const std::optional<int> index = find_column(table, column);
  return index ? table.rows[row][static_cast<std::size_t>(*index)] : std::string();
}

SurfacePoint place_on(const Surface& surface, const Vec3& position, const CsvTable& table, std::size_t row) {
  const SurfacePoint place = surface.project(position);
  const double distance = (surface.position(place) - position).norm();
  if (distance <= kFarthest) return place;
  throw IoError(table.name + ":" + std::to_string(table.lines[row]) + ": the position (" + text_of(position.x()) + ", " +
                text_of(position.y()) + ", " + text_of(position.z()) + ") m is " + text_of(distance) +
                " m from the surface; at most 0.005 m is allowed");
}

double noise_variance_at(const Cells& cells, const CsvTable& table, std::size_t row) {
  if (!cells[row]) return std::numeric_limits<double>::quiet_NaN();
  if (std::isfinite(*cells[row]) && *cells[row] >= 0.0) return *cells[row];
  fail_at_cell(table, static_cast<int>(row), "noise_variance", "must be empty, or a finite number that is not negative");
}

int batch_at(const CsvTable& table, std::size_t row) {
  const std::string word = word_at(table, row, "batch");
  if (word.empty()) return 0;
  const std::optional<std::int64_t> batch = parse_integer(word);
  if (batch && *batch >= 0 && *batch <= std::numeric_limits<int>::max()) return static_cast<int>(*batch);
  fail_at_cell(table, static_cast<int>(row), "batch", "must be empty, or a whole number that is not negative");
}

TouchKind kind_at(const CsvTable& table, std::size_t row) {
  const std::string word = word_at(table, row, "kind");
  if (word.empty() || word == "stop") return TouchKind::Stop;
  if (word == "way") return TouchKind::Way;
  fail_at_cell(table, static_cast<int>(row), "kind", "must be stop, way or empty");
}

/// Zero stands for an unknown direction, as do three empty cells.
Vec3 travel_at(const std::array<Cells, 3>& cells, const CsvTable& table, std::size_t row) {
  if (!cells[0][row] && !cells[1][row] && !cells[2][row]) return Vec3::Zero();
  Vec3 travel;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string column = std::string("t") + "xyz"[i];
    if (!cells[i][row] || !std::isfinite(*cells[i][row])) {
      fail_at_cell(table, static_cast<int>(row), column, "must be a finite number, or tx, ty and tz be empty");
    }
    travel[static_cast<Eigen::Index>(i)] = *cells[i][row];
  }
  // What is a unit vector but for rounding keeps its digits, so that a file comes back as it was written.
  const bool is_unit = std::abs(travel.norm() - 1.0) <= 1e-12;
  return is_unit ? travel : Vec3(travel.stableNormalized());
}

std::string noise_text(double variance) { return std::isnan(variance) ? std::string() : text_of(variance); }

}  // namespace

MeasurementsFile read_measurements(const std::filesystem::path& path, const Surface& surface) {
  const CsvTable table = read_csv(path);
  const std::vector<double> x = finite_numbers(table, "x"), y = finite_numbers(table, "y"), z = finite_numbers(table, "z");
  const std::vector<double> readings = finite_numbers(table, "reading");
  const Cells noise = optional_numbers(table, "noise_variance");
  const std::array<Cells, 3> travel = {optional_numbers(table, "tx"), optional_numbers(table, "ty"), optional_numbers(table, "tz")};
  MeasurementsFile file;
  file.palpations.reserve(table.rows.size());
  int moved = 0;
  double farthest = 0.0;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    file.palpations.push_back({.where = place_on(surface, Vec3(x[row], y[row], z[row]), table, row),
                               .reading = readings[row],
                               .noise_variance = noise_variance_at(noise, table, row),
                               .batch = batch_at(table, row),
                               .kind = kind_at(table, row),
                               .travel = travel_at(travel, table, row),
                               .set_aside = word_at(table, row, "set_aside")});
    const double distance = (surface.position(file.palpations.back().where) - Vec3(x[row], y[row], z[row])).norm();
    farthest = std::max(farthest, distance);
    if (distance > kUnremarkable) ++moved;
  }
  if (moved > 0) {
    file.warnings.push_back(table.name + ": " + std::to_string(moved) + " of " + std::to_string(table.rows.size()) +
                            " positions lay off the surface, by up to " + text_of(farthest) + " m, and were taken to its closest points.");
  }
  return file;
}

std::string measurements_csv(const Surface& surface, std::span<const Palpation> palpations) {
  std::string text = "x,y,z,reading,noise_variance,batch,kind,tx,ty,tz,set_aside\n";
  for (const Palpation& palpation : palpations) {
    const Vec3 position = surface.position(palpation.where);
    const auto travel = [&](int i) { return palpation.travel.isZero(0.0) ? std::string() : text_of(palpation.travel[i]); };
    const std::array<std::string, 11> cells = {text_of(position.x()),
                                               text_of(position.y()),
                                               text_of(position.z()),
                                               text_of(palpation.reading),
                                               noise_text(palpation.noise_variance),
                                               std::to_string(palpation.batch),
                                               palpation.kind == TouchKind::Stop ? "stop" : "way",
                                               travel(0),
                                               travel(1),
                                               travel(2),
                                               palpation.set_aside};
    text += csv_line(cells);
  }
  return text;
}

}  // namespace palpation
