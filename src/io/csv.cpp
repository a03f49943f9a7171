#include "palpation/io/csv.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/mesh_text.h"
#include "io/number_text.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"

namespace palpation {
namespace {

constexpr std::size_t kLongestLine = 1 << 16;
constexpr std::size_t kMostColumns = 1024;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

[[noreturn]] void fail_at_line(const std::string& name, std::int64_t line, const std::string& what) {
  throw IoError(name + ":" + std::to_string(line) + ": " + what);
}

/// Cuts one line into cells.
class LineCutter {
 public:
  LineCutter(std::string_view line, const std::string& name, std::int64_t number) : rest_(line), name_(name), number_(number) {}

  std::vector<std::string> cells() {
    std::vector<std::string> cells;
    do {
      if (cells.size() == kMostColumns) fail_at_line(name_, number_, "more than " + std::to_string(kMostColumns) + " columns");
      cells.push_back(next_cell());
    } while (take_comma());
    return cells;
  }

 private:
  std::string next_cell() {
    const std::string_view ahead = trimmed(rest_);
    if (!ahead.empty() && ahead[0] == '"') return quoted_cell();
    const std::size_t end = std::min(rest_.find(','), rest_.size());
    const std::string_view cell = trimmed(rest_.substr(0, end));
    if (cell.find('"') != std::string_view::npos) fail_at_line(name_, number_, "a quote inside the cell " + in_quotes(cell));
    rest_.remove_prefix(end);
    return std::string(cell);
  }

  std::string quoted_cell() {
    rest_.remove_prefix(rest_.find('"') + 1);
    std::string cell;
    while (true) {
      const std::size_t quote = rest_.find('"');
      if (quote == std::string_view::npos) fail_at_line(name_, number_, "a quoted cell does not end on its line");
      cell += rest_.substr(0, quote);
      rest_.remove_prefix(quote + 1);
      if (rest_.empty() || rest_[0] != '"') break;
      cell += '"';
      rest_.remove_prefix(1);
    }
    const std::size_t end = std::min(rest_.find(','), rest_.size());
    if (!trimmed(rest_.substr(0, end)).empty()) fail_at_line(name_, number_, "text behind the quoted cell " + in_quotes(cell));
    rest_.remove_prefix(end);
    return cell;
  }

  bool take_comma() {
    if (rest_.empty()) return false;
    rest_.remove_prefix(1);
    return true;
  }

  std::string_view rest_;
  const std::string& name_;
  std::int64_t number_;
};

void check_columns(const CsvTable& table, std::int64_t line) {
  std::vector<std::string> sorted = table.columns;
  std::sort(sorted.begin(), sorted.end());
  if (sorted.front().empty()) fail_at_line(table.name, line, "a column has no name");
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) fail_at_line(table.name, line, "column " + in_quotes(*twice) + " appears twice");
}

void append_row(CsvTable& table, std::vector<std::string> cells, std::int64_t line) {
  if (cells.size() != table.columns.size()) {
    fail_at_line(table.name, line,
                 std::to_string(cells.size()) + " cells, but the header names " + std::to_string(table.columns.size()) + " columns");
  }
  if (line > std::numeric_limits<int>::max()) fail_at_line(table.name, line, "more than 2^31 - 1 lines");
  table.rows.push_back(std::move(cells));
  table.lines.push_back(static_cast<int>(line));
}

}  // namespace

CsvTable read_csv(const std::filesystem::path& path) { return parse_csv(read_file(path), path.string()); }

CsvTable parse_csv(std::string_view text, const std::string& name) {
  const std::size_t nul = text.find('\0');
  if (nul != std::string_view::npos) throw IoError(name + ", byte " + std::to_string(nul) + ": a NUL byte has no place in a text file");
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) text.remove_prefix(kByteOrderMark.size());
  CsvTable table{name, {}, {}, {}};
  LineCursor lines(text);
  while (const std::optional<std::string_view> line = lines.next()) {
    if (line->size() > kLongestLine) fail_at_line(name, lines.line(), "a line of more than " + std::to_string(kLongestLine) + " bytes");
    if (trimmed(*line).empty()) continue;
    std::vector<std::string> cells = LineCutter(*line, name, lines.line()).cells();
    if (table.columns.empty()) {
      table.columns = std::move(cells);
      check_columns(table, lines.line());
    } else {
      append_row(table, std::move(cells), lines.line());
    }
  }
  if (table.columns.empty()) throw IoError(name + ": the file is empty; a header line that names the columns is expected");
  return table;
}

std::optional<int> find_column(const CsvTable& table, std::string_view column) {
  const auto found = std::find(table.columns.begin(), table.columns.end(), column);
  if (found == table.columns.end()) return std::nullopt;
  return static_cast<int>(found - table.columns.begin());
}

int column_index(const CsvTable& table, std::string_view column) {
  if (const std::optional<int> index = find_column(table, column)) return *index;
  std::string names;
  for (const std::string& other : table.columns) names += (names.empty() ? "" : ", ") + other;
  throw IoError(table.name + ": no column " + in_quotes(column) + " among " + in_quotes(names));
}

void fail_at_cell(const CsvTable& table, int row, std::string_view column, const std::string& rule) {
  const auto index = static_cast<std::size_t>(row);
  const std::optional<int> cell = find_column(table, column);
  const std::string value = cell ? in_quotes(table.rows[index][static_cast<std::size_t>(*cell)]) + " " : "";
  fail_at_line(table.name, table.lines[index], "column " + std::string(column) + ": " + value + rule);
}

std::vector<std::optional<double>> numbers(const CsvTable& table, std::string_view column) {
  const auto index = static_cast<std::size_t>(column_index(table, column));
  std::vector<std::optional<double>> values(table.rows.size());
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::string& cell = table.rows[row][index];
    if (cell.empty()) continue;
    const ParsedNumber number = parse_number(cell);
    if (number.status == NumberStatus::NotANumber) fail_at_cell(table, static_cast<int>(row), column, "is not a number");
    if (number.status == NumberStatus::TooLarge) fail_at_cell(table, static_cast<int>(row), column, "is too large for a double");
    values[row] = number.value;
  }
  return values;
}

std::vector<double> finite_numbers(const CsvTable& table, std::string_view column) {
  const std::vector<std::optional<double>> cells = numbers(table, column);
  std::vector<double> values;
  values.reserve(cells.size());
  for (std::size_t row = 0; row < cells.size(); ++row) {
    if (!cells[row] || !std::isfinite(*cells[row])) fail_at_cell(table, static_cast<int>(row), column, "must be a finite number");
    values.push_back(*cells[row]);
  }
  return values;
}

std::string csv_line(std::span<const std::string> cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) line += ',';
    std::string cell = cells[i];
    std::replace_if(
        cell.begin(), cell.end(), [](char c) { return c == '\n' || c == '\r' || c == '\0'; }, ' ');
    const bool plain = cell.find_first_of(",\"") == std::string::npos && trimmed(cell).size() == cell.size();
    if (plain) {
      line += cell;
      continue;
    }
    line += '"';
    for (const char c : cell) line.append(c == '"' ? 2 : 1, c);
    line += '"';
  }
  return line + '\n';
}

}  // namespace palpation
