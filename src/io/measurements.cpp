#include "palpation/io/measurements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "io/landing.h"
#include "io/measurement_columns.h"
#include "io/measurement_rows.h"
#include "io/number_text.h"
#include "io/places.h"
#include "palpation/base/error.h"
#include "palpation/io/csv.h"
#include "readings/readings.h"

namespace palpation {
namespace {

constexpr double kRounding_m = 1e-15;
constexpr double kGreatestReading = 1e30;
constexpr double kLeastRange = 1e-30;
constexpr double kGreatestVariance = 1e60;
constexpr double kLeastVariance = 1e-60;
constexpr std::int64_t kLastBatch = 1'000'000;
constexpr std::size_t kEnoughForOutliers = 8;
constexpr double kFarOut =
    1000.0;  // times the width of the middle half: neither noise nor a tumour

struct Columns {
  explicit Columns(const CsvTable& table)
      : position{column_index(table, "x"), column_index(table, "y"), column_index(table, "z")},
        reading(column_index(table, "reading")),
        noise_variance(find_column(table, "noise_variance")),
        batch(find_column(table, "batch")),
        kind(find_column(table, "kind")),
        travel{find_column(table, "tx"), find_column(table, "ty"), find_column(table, "tz")} {}

  std::array<std::size_t, 3> position;
  std::size_t reading;
  std::optional<std::size_t> noise_variance, batch, kind;
  std::array<std::optional<std::size_t>, 3> travel;
};

/// A cell of a column that may be missing: then all its cells are empty.
std::string_view word_at(const CsvTable& table, std::size_t row,
                         const std::optional<std::size_t>& column) {
  return column ? table.cell(row, *column) : std::string_view();
}

double reading_at(const CsvTable& table, std::size_t row, std::size_t column) {
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
  fail_at_cell(table, row, *column, "must be stop, way or empty");
}

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

SurfacePoint place_at(Landing& landing, const Vec3& position, const CsvTable& table,
                      std::size_t row) {
  std::string fault;
  const std::optional<SurfacePoint> place = landing.place(position, fault);
  if (!place) fail_at_row(table, row, fault);
  return *place;
}

/// Readings by place: repeats are at one place exactly, and without noise they agree.
class Repeats {
 public:
  /// The place that a reading counts for: its own, or an earlier one within reach.
  SurfacePoint settle(const SurfacePoint& where, const Vec3& position, const CsvTable& table,
                      std::size_t row, double reading, bool exact) {
    const std::size_t number = places_.number_of(where, position);
    if (number == exact_rows_.size()) exact_rows_.emplace_back();
    if ((places_[number].position - position).norm() > kRounding_m) ++joined_;
    std::optional<Exact>& first = exact_rows_[number];
    if (exact && first && first->reading != reading) {
      fail_at_row(table, row,
                  "the reading " + text_of(reading) + " contradicts " + text_of(first->reading) +
                      " in line " + std::to_string(table.line(first->row)) +
                      ": both are at one place and without noise");
    }
    if (exact && !first) first = Exact{row, reading};
    return places_[number].where;
  }

  std::size_t places() const { return places_.size(); }

  void tell(const std::string& name, std::vector<std::string>& warnings) const {
    if (joined_ == 0) return;
    warnings.push_back(name + ": " + std::to_string(joined_) +
                       (joined_ == 1 ? " position lies" : " positions lie") +
                       " within a nanometre of an earlier one, and counts as the same place.");
  }

 private:
  struct Exact {
    std::size_t row;
    double reading;
  };
  Places places_;
  std::vector<std::optional<Exact>> exact_rows_;  // by place
  int joined_ = 0;
};

double at_rank(std::vector<double> values, double share) {
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

/// Readings that stand out by more than any tissue does are kept, and told: a probe that slipped
/// decides where the level lies.
void tell_outliers(const CsvTable& table, const std::vector<Palpation>& palpations,
                   std::vector<std::string>& warnings) {
  const std::vector<double> used = used_readings(palpations);
  if (used.size() < kEnoughForOutliers) return;
  const double low = at_rank(used, 0.25), middle = at_rank(used, 0.5), high = at_rank(used, 0.75);
  if (!(high > low)) return;
  std::string lines;
  int count = 0;
  for (std::size_t row = 0; row < palpations.size(); ++row) {
    const Palpation& palpation = palpations[row];
    if (!palpation.set_aside.empty() ||
        std::abs(palpation.reading - middle) <= kFarOut * (high - low))
      continue;
    if (++count <= 5)
      lines += (lines.empty() ? "" : ", ") + std::to_string(table.line(row)) + " (" +
               text_of(palpation.reading) + ")";
  }
  if (count == 0) return;
  warnings.push_back(
      table.name() + ": " +
      (count == 1 ? "1 reading stands" : std::to_string(count) + " readings stand") +
      " more than 1000 times as far out as the middle half of all readings is wide, in line " +
      lines + (count > 5 ? " and others" : "") + (count == 1 ? ". It counts" : ". They count") +
      " like the others; if the probe slipped, say so in the column set_aside.");
}

void check_range(const CsvTable& table, const std::vector<Palpation>& palpations) {
  const std::vector<double> used = used_readings(palpations);
  if (all_equal(used)) return;
  const auto [least, most] = std::ranges::minmax(used);
  if (most - least < kLeastRange)
    throw IoError(
        table.name() + ": column reading: the readings differ by " + text_of(most - least) +
        " at most; where they differ it must be by 1e-30 at least: write them in another unit");
}

/// Rows that were given twice tell nothing new, and readings that never scatter would pass for ones
/// without noise. A sensor that counts may repeat itself to the last digit at a place touched
/// again, but not more often than not.
void set_aside_copies(const CsvTable& table, const Surface& surface,
                      std::vector<Palpation>& palpations, std::vector<std::string>& warnings) {
  std::map<std::array<double, 3>, std::map<std::array<double, 2>, std::size_t>>
      rows_at;  // by place, then reading and noise
  std::vector<std::pair<std::size_t, std::size_t>> copies;
  std::size_t revisits = 0;
  for (std::size_t row = 0; row < palpations.size(); ++row) {
    if (!palpations[row].set_aside.empty()) continue;
    const Vec3 place = surface.position(palpations[row].where);
    auto& rows = rows_at[{place.x(), place.y(), place.z()}];
    revisits += !rows.empty();
    const double noise =
        std::isnan(palpations[row].noise_variance) ? -1.0 : palpations[row].noise_variance;
    const auto [first, is_new] = rows.try_emplace({palpations[row].reading, noise}, row);
    if (!is_new) copies.emplace_back(row, first->second);
  }
  if (copies.empty() || 2 * copies.size() < revisits) return;
  for (const auto& [row, first] : copies)
    palpations[row].set_aside = "copy of line " + std::to_string(table.line(first));
  const auto& [row, first] = copies.front();
  const std::string words =
      copies.size() == 1
          ? " row repeats an earlier one, place and reading alike to every digit, and is"
          : " rows repeat earlier ones, place and reading alike to every digit, and are";
  warnings.push_back(table.name() + ": " + std::to_string(copies.size()) + words +
                     " set aside: line " + std::to_string(table.line(row)) + " repeats line " +
                     std::to_string(table.line(first)) + ".");
}

}  // namespace

MeasurementsFile read_measurements(const std::filesystem::path& path, const Surface& surface,
                                   const MeasurementRules& rules) {
  const CsvTable table = read_csv(path);
  const Columns columns(table);
  Landing landing(surface);
  Repeats repeats;
  MeasurementsFile file;
  file.palpations.reserve(table.row_count());
  std::size_t farthest_row = 0;
  check_reading_unit(table, rules.reading_unit);
  const std::vector<bool> is_off = rules.leave_out_off_tissue
                                       ? rows_off_tissue(table, surface, file.warnings)
                                       : std::vector<bool>(table.row_count(), false);
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    if (is_off[row]) continue;
    Vec3 position;
    for (std::size_t i = 0; i < 3; ++i)
      position[static_cast<Eigen::Index>(i)] = finite_number_at(table, row, columns.position[i]);
    const double farthest_m = landing.farthest_m();
    Palpation palpation{.where = place_at(landing, position, table, row),
                        .reading = reading_at(table, row, columns.reading),
                        .noise_variance = noise_variance_at(table, row, columns.noise_variance),
                        .batch = batch_at(table, row, columns.batch),
                        .kind = kind_at(table, row, columns.kind),
                        .travel = travel_at(table, row, columns.travel),
                        .set_aside = set_aside_at(table, row)};
    if (landing.farthest_m() > farthest_m) farthest_row = row;
    if (palpation.set_aside.empty()) {
      const bool exact = palpation.noise_variance == 0.0 ||
                         (rules.empty_noise_is_none && std::isnan(palpation.noise_variance));
      palpation.where = repeats.settle(palpation.where, surface.position(palpation.where), table,
                                       row, palpation.reading, exact);
    }
    file.palpations.push_back(std::move(palpation));
  }
  check_range(table, file.palpations);
  set_aside_copies(table, surface, file.palpations, file.warnings);
  file.places = static_cast<int>(repeats.places());
  file.foreign = foreign_columns(table, is_off);
  if (landing.moved() > 0) {
    file.warnings.push_back(
        table.name() + ": " + std::to_string(landing.moved()) + " of " +
        std::to_string(table.row_count()) + " positions lay off the surface, by up to " +
        text_of(landing.farthest_m()) + " m in line " + std::to_string(table.line(farthest_row)) +
        ", and were taken to its closest points.");
  }
  repeats.tell(table.name(), file.warnings);
  tell_outliers(table, file.palpations, file.warnings);
  return file;
}

}  // namespace palpation
