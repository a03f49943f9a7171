#include "palpation/io/measurements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "io/common_shift.h"
#include "io/landing.h"
#include "io/measurement_checks.h"
#include "io/measurement_columns.h"
#include "io/measurement_rows.h"
#include "io/number_text.h"
#include "palpation/base/error.h"
#include "palpation/io/csv.h"
#include "readings/readings.h"

namespace palpation {
namespace {

constexpr double kGreatestReading = 1e30;
constexpr double kGreatestVariance = 1e60;
constexpr double kLeastVariance = 1e-60;
constexpr std::int64_t kLastBatch = 1'000'000;

struct Columns {
  explicit Columns(const CsvTable& table)
      : position{column_index(table, "x"), column_index(table, "y"), column_index(table, "z")},
        reading(column_index(table, "reading")),
        noise_variance(find_column(table, "noise_variance")),
        batch(find_column(table, "batch")),
        kind(find_column(table, "kind")),
        session(find_column(table, "session")),
        travel{find_column(table, "tx"), find_column(table, "ty"), find_column(table, "tz")} {}

  std::array<std::size_t, 3> position;
  std::size_t reading;
  std::optional<std::size_t> noise_variance, batch, kind, session;
  std::array<std::optional<std::size_t>, 3> travel;
};

/// A cell of a column that may be missing: then all its cells are empty.
std::string_view word_at(const CsvTable& table, std::size_t row,
                         const std::optional<std::size_t>& column) {
  return column ? table.cell(row, *column) : std::string_view();
}

/// Nothing was read where there was no contact.
double reading_at(const CsvTable& table, std::size_t row, std::size_t column, TouchKind kind) {
  if (kind == TouchKind::Missed) {
    if (table.cell(row, column).empty()) return std::numeric_limits<double>::quiet_NaN();
    fail_at_cell(table, row, column, "must be empty where kind is missed");
  }
  const double reading = finite_number_at(table, row, column);
  if (std::abs(reading) <= kGreatestReading) return reading;
  fail_at_cell(table, row, column, "must be at most 1e30 in size: write it in another unit");
}

double noise_variance_at(const CsvTable& table, std::size_t row,
                         const std::optional<std::size_t>& column) {
  if (word_at(table, row, column).empty()) return std::numeric_limits<double>::quiet_NaN();
  const double variance = finite_number_at(table, row, *column);
  if (variance == 0.0 || (variance >= kLeastVariance && variance <= kGreatestVariance))
    return variance;
  fail_at_cell(table, row, *column, "must be empty, 0, or 1e-60 to 1e60");
}

int batch_at(const CsvTable& table, std::size_t row, const std::optional<std::size_t>& column) {
  const std::string_view word = word_at(table, row, column);
  if (word.empty()) return 0;
  const std::optional<std::int64_t> batch = parse_integer(word);
  if (batch && *batch >= 0 && *batch <= kLastBatch) return static_cast<int>(*batch);
  fail_at_cell(table, row, *column, "must be empty, or a whole number from 0 to 1000000");
}

TouchKind kind_at(const CsvTable& table, std::size_t row,
                  const std::optional<std::size_t>& column) {
  const std::string_view word = word_at(table, row, column);
  if (word.empty() || word == "stop") return TouchKind::Stop;
  if (word == "way") return TouchKind::Way;
  if (word == "missed") return TouchKind::Missed;
  fail_at_cell(table, row, *column, "must be stop, way, missed or empty");
}

/// Sessions by their names, numbered as they come.
class Sessions {
 public:
  int number_of(std::string_view name) {
    return numbers_.try_emplace(std::string(name), static_cast<int>(numbers_.size())).first->second;
  }

 private:
  std::map<std::string, int> numbers_;
};

/// Zero stands for an unknown direction, as do three empty cells.
Vec3 travel_at(const CsvTable& table, std::size_t row,
               const std::array<std::optional<std::size_t>, 3>& columns) {
  const auto is_empty = [&](const std::optional<std::size_t>& column) {
    return word_at(table, row, column).empty();
  };
  if (std::all_of(columns.begin(), columns.end(), is_empty)) return Vec3::Zero();
  Vec3 travel;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!columns[i])
      fail_at_row(
          table, row,
          "there is no column t" + std::string(1, "xyz"[i]) + ": a direction needs tx, ty and tz");
    if (is_empty(columns[i]))
      fail_at_cell(table, row, *columns[i], "must be a finite number, or tx, ty and tz be empty");
    travel[static_cast<Eigen::Index>(i)] = finite_number_at(table, row, *columns[i]);
  }
  // What is a unit vector but for rounding keeps its digits, so that a file comes back as it was
  // written.
  const bool is_unit = std::abs(travel.norm() - 1.0) <= 1e-12;
  return is_unit ? travel : Vec3(travel.stableNormalized());
}

/// Batches of a session that begin anew follow those before it.
void let_batches_follow(std::vector<Palpation>& palpations) {
  int session = 0, last = 0, later = 0;
  for (Palpation& one : palpations) {
    if (counts(one) && one.session > session) {
      session = one.session;
      later = one.batch > last ? 0 : last + 1 - one.batch;
    }
    one.batch += later;
    last = std::max(last, one.batch);
  }
}

SurfacePoint place_at(Landing& landing, const Vec3& position, const CsvTable& table,
                      std::size_t row) {
  std::string fault;
  const std::optional<SurfacePoint> place = landing.place(position, fault);
  if (!place) fail_at_row(table, row, fault);
  return *place;
}

std::string off_surface_words(const CsvTable& table, const Landing& landing,
                              std::size_t farthest_row) {
  return table.name() + ": " + std::to_string(landing.moved()) + " of " +
         std::to_string(table.row_count()) + " positions lay off the surface, by up to " +
         length_text(landing.farthest_m()) + " m in line " +
         std::to_string(table.line(farthest_row)) + ", and were taken to its closest points.";
}

}  // namespace

MeasurementsFile read_measurements(const std::filesystem::path& path, const Surface& surface,
                                   const MeasurementRules& rules) {
  return measurements_of(read_csv(path), surface, rules);
}

MeasurementsFile measurements_of(const CsvTable& table, const Surface& surface,
                                 const MeasurementRules& rules) {
  const Columns columns(table);
  Landing landing(surface);
  Repeats repeats;
  Sessions sessions;
  MeasurementsFile file;
  file.has_batches = columns.batch.has_value();
  file.palpations.reserve(table.row_count());
  std::vector<std::size_t> rows;  // of what was made
  std::vector<Vec3> positions;
  std::vector<SurfacePoint> landed;
  std::size_t farthest_row = 0;
  check_reading_unit(table, rules.reading_unit);
  tell_times(table, file.warnings);
  const std::vector<bool> is_off = rules.leave_out_off_tissue
                                       ? rows_off_tissue(table, surface, file.warnings)
                                       : std::vector<bool>(table.row_count(), false);
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    if (is_off[row]) continue;
    Vec3 position;
    for (std::size_t i = 0; i < 3; ++i)
      position[static_cast<Eigen::Index>(i)] = finite_number_at(table, row, columns.position[i]);
    const double farthest_m = landing.farthest_m();
    const TouchKind kind = kind_at(table, row, columns.kind);
    Palpation palpation{.where = place_at(landing, position, table, row),
                        .reading = reading_at(table, row, columns.reading, kind),
                        .noise_variance = noise_variance_at(table, row, columns.noise_variance),
                        .batch = batch_at(table, row, columns.batch),
                        .kind = kind,
                        .travel = travel_at(table, row, columns.travel),
                        .set_aside = set_aside_at(table, row)};
    if (counts(palpation))
      palpation.session = sessions.number_of(word_at(table, row, columns.session));
    if (landing.farthest_m() > farthest_m) farthest_row = row;
    if (counts(palpation)) {
      positions.push_back(position);
      landed.push_back(palpation.where);
      const bool exact = palpation.noise_variance == 0.0 ||
                         (rules.empty_noise_is_none && std::isnan(palpation.noise_variance));
      palpation.where = repeats.settle(palpation.where, surface.position(palpation.where), table,
                                       row, palpation.reading, exact);
    }
    rows.push_back(row);
    file.palpations.push_back(std::move(palpation));
  }
  if (file.has_batches) let_batches_follow(file.palpations);
  check_range(table, file.palpations);
  set_aside_copies(table, rows, surface, file.palpations, file.warnings);
  file.places = static_cast<int>(repeats.places());
  file.foreign = foreign_columns(table, is_off);
  if (landing.moved() > 0) file.warnings.push_back(off_surface_words(table, landing, farthest_row));
  if (const std::optional<CommonShift> shift = common_shift(surface, positions, landed))
    file.warnings.push_back(shift_words(table.name(), *shift));
  repeats.tell(table.name(), file.warnings);
  tell_outliers(table, rows, file.palpations, file.warnings);
  return file;
}

}  // namespace palpation
