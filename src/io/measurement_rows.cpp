#include "io/measurement_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "io/landing.h"
#include "io/measurement_columns.h"
#include "io/number_text.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

std::string_view word_at(const CsvTable& table, std::size_t row, std::string_view column) {
  const std::optional<std::size_t> index = find_column(table, column);
  return index ? table.cell(row, *index) : std::string_view();
}

double off_m(const Surface& surface, const Vec3& position) {
  // Squares of what is farther off than any tissue need not be doubles.
  if (position.cwiseAbs().maxCoeff() > 1e6) return position.cwiseAbs().maxCoeff();
  return (surface.position(surface.project(position)) - position).norm();
}

}  // namespace

std::vector<bool> rows_off_tissue(const CsvTable& table, const Surface& surface,
                                  std::vector<std::string>& warnings) {
  const std::array<std::size_t, 3> columns = {column_index(table, "x"), column_index(table, "y"),
                                              column_index(table, "z")};
  Landing landing(surface);
  std::vector<bool> is_off(table.row_count(), false);
  std::string first_fault;
  std::size_t count = 0, first = 0, farthest = 0;
  double farthest_m = 0.0;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    Vec3 position;
    for (std::size_t i = 0; i < 3; ++i)
      position[static_cast<Eigen::Index>(i)] = finite_number_at(table, row, columns[i]);
    std::string fault;
    if (landing.place(position, fault)) continue;
    is_off[row] = true;
    if (count++ == 0) first_fault = fault, first = row;
    const double here_m = off_m(surface, position);
    if (here_m > farthest_m) farthest_m = here_m, farthest = row;
  }
  if (count == 0) return is_off;
  if (count == table.row_count())
    fail_at_row(table, first, first_fault + "; no reading lies on the tissue");
  warnings.push_back(
      table.name() + ": " + std::to_string(count) + " of " + std::to_string(table.row_count()) +
      (count == 1 ? " readings lies" : " readings lie") + " off the tissue and " +
      (count == 1 ? "was" : "were") + " left out, the farthest by " + length_text(farthest_m) +
      " m in line " + std::to_string(table.line(farthest)) + ".");
  return is_off;
}

ForeignColumns foreign_columns(const CsvTable& table, const std::vector<bool>& is_off) {
  std::vector<std::size_t> numbers;
  ForeignColumns foreign;
  for (std::size_t column = 0; column < table.columns().size(); ++column) {
    const std::string& name = table.columns()[column];
    if (std::ranges::find(kMeasurementColumns, name) != kMeasurementColumns.end()) continue;
    numbers.push_back(column);
    foreign.names.push_back(name);
  }
  if (numbers.empty()) return foreign;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    if (is_off[row]) continue;
    foreign.rows.emplace_back();
    for (const std::size_t column : numbers)
      foreign.rows.back().emplace_back(table.cell(row, column));
  }
  return foreign;
}

std::string set_aside_at(const CsvTable& table, std::size_t row) {
  const std::string_view given = word_at(table, row, "set_aside");
  if (!given.empty()) return std::string(given);
  const std::string_view withdrawn = word_at(table, row, "withdrawn");
  constexpr std::array<std::string_view, 4> kNo = {"", "0", "no", "false"};
  constexpr std::array<std::string_view, 4> kYes = {"1", "yes", "true", "x"};
  if (std::ranges::find(kNo, withdrawn) != kNo.end()) return {};
  if (std::ranges::find(kYes, withdrawn) != kYes.end()) return "withdrawn";
  return "withdrawn: " + std::string(withdrawn);
}

void check_reading_unit(const CsvTable& table, const std::string& unit) {
  const std::optional<std::size_t> column = find_column(table, "reading_unit");
  if (!column) return;
  std::string expected = unit;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    const std::string_view here = table.cell(row, *column);
    if (here.empty()) continue;
    if (expected.empty()) expected = here;
    if (here != expected)
      fail_at_cell(table, row, *column,
                   "is another unit than " + in_quotes(expected) +
                       (unit.empty() ? " in the rows above" : ", the scene's reading_unit") +
                       ": readings of one tissue have one");
  }
}

void tell_times(const CsvTable& table, std::vector<std::string>& warnings) {
  const std::optional<std::size_t> column = find_column(table, "t");
  if (!column) return;
  std::map<std::string_view, double> last;  // in each session
  std::size_t falls = 0, fallen = 0;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    const std::string_view word = table.cell(row, *column);
    if (word.empty()) continue;
    const ParsedNumber time = parse_number(word);
    if (time.status == NumberStatus::NotANumber) {
      warnings.push_back(table.name() + ": t is no number of seconds, first " + in_quotes(word) +
                         " in line " + std::to_string(table.line(row)) + ": it is not looked at.");
      return;
    }
    if (time.status != NumberStatus::Fine || std::isnan(time.value)) continue;
    const auto [before, is_first] = last.try_emplace(word_at(table, row, "session"), time.value);
    if (!is_first && time.value < before->second && falls++ == 0) fallen = row;
    before->second = time.value;
  }
  if (falls == 0) return;
  warnings.push_back(table.name() + ": t falls " +
                     (falls == 1 ? "once" : std::to_string(falls) + " times") + ", first in line " +
                     std::to_string(table.line(fallen)) +
                     ", but rows count as made in their order: what drifted, moved or came late "
                     "is looked for in that. If t is right, sort the rows by it.");
}

}  // namespace palpation
