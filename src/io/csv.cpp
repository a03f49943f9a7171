#include "palpation/io/csv.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/mesh_text.h"
#include "io/number_text.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"

namespace palpation {
namespace {

constexpr std::size_t kLongestLine = 1 << 16;
constexpr std::size_t kMostColumns = 1024;
constexpr std::size_t kMostBytes = std::size_t{1} << 30;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

[[noreturn]] void fail_at_line(const std::string& name, std::int64_t line,
                               const std::string& what) {
  throw IoError(name + ":" + std::to_string(line) + ": " + what);
}

/// Cuts one line into cells.
class LineCutter {
 public:
  LineCutter(std::string_view line, const std::string& name, std::int64_t number)
      : rest_(line), name_(name), number_(number) {}

  std::vector<std::string> cells() {
    std::vector<std::string> cells;
    do {
      if (cells.size() == kMostColumns)
        fail_at_line(name_, number_, "more than " + std::to_string(kMostColumns) + " columns");
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
    if (cell.find('"') != std::string_view::npos)
      fail_at_line(name_, number_, "a quote inside the cell " + in_quotes(cell));
    rest_.remove_prefix(end);
    return std::string(cell);
  }

  std::string quoted_cell() {
    rest_.remove_prefix(rest_.find('"') + 1);
    std::string cell;
    while (true) {
      const std::size_t quote = rest_.find('"');
      if (quote == std::string_view::npos)
        fail_at_line(name_, number_, "a quoted cell does not end on its line");
      cell += rest_.substr(0, quote);
      rest_.remove_prefix(quote + 1);
      if (rest_.empty() || rest_[0] != '"') break;
      cell += '"';
      rest_.remove_prefix(1);
    }
    const std::size_t end = std::min(rest_.find(','), rest_.size());
    if (!trimmed(rest_.substr(0, end)).empty())
      fail_at_line(name_, number_, "text behind the quoted cell " + in_quotes(cell));
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

constexpr const char* kComment = "begins with #, but a table has no lines of comment: take it away";

bool is_number(const std::string& word) {
  return parse_number(word).status != NumberStatus::NotANumber;
}

void check_columns(const std::vector<std::string>& columns, const std::string& name,
                   std::int64_t line) {
  if (columns.size() == 1) {
    const std::string_view header = columns.front();
    if (header.starts_with('#'))
      fail_at_line(name, line,
                   kComment + std::string(": the line that names the columns is first"));
    for (const auto& [mark, word] : {std::pair(';', "semicolons"), std::pair('\t', "tabs")}) {
      if (header.find(mark) != std::string_view::npos)
        fail_at_line(name, line,
                     std::string("the header has ") + word +
                         " between its cells: commas are expected, and points in decimals");
    }
  }
  if (std::all_of(columns.begin(), columns.end(), is_number))
    fail_at_line(name, line,
                 "the header line, which names the columns, is missing: this one holds numbers");
  std::vector<std::string> sorted = columns;
  std::sort(sorted.begin(), sorted.end());
  if (sorted.front().empty())
    fail_at_line(name, line,
                 std::string("a column has no name") +
                     (columns.back().empty() ? ": take the comma at the line's end away" : ""));
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end())
    fail_at_line(name, line, "column " + in_quotes(*twice) + " appears twice");
}

/// What is wrong with how many cells a row has; empty if nothing is.
std::string row_fault(const std::vector<std::string>& cells, std::size_t columns) {
  if (cells.size() == columns) return {};
  if (cells.front().starts_with('#')) return kComment;
  std::string hint;
  if (cells.size() == columns + 1 && cells.back().empty())
    hint = " (a comma at the line's end is one too many)";
  else if (cells.size() > columns)
    hint = " (decimals take a point, not a comma)";
  return std::to_string(cells.size()) + (cells.size() == 1 ? " cell" : " cells") +
         ", but the header names " + std::to_string(columns) + " columns" + hint;
}

/// Half a number is a number too: 806.0 that was cut to 8 would be believed.
constexpr const char* kOpenEnd = "the last line has no line end, so it may have been cut short";
constexpr const char* kMendOpenEnd =
    ": if it is whole, end it with a newline (echo >> FILE), else take it away";

std::string_view without_mark(std::string_view text, const std::string& name) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  const std::size_t nul = text.find('\0');
  if (nul != std::string_view::npos)
    throw IoError(name + ", byte " + std::to_string(nul) +
                  ": a NUL byte has no place in a text file (if this is UTF-16, save it as UTF-8)");
  return text.substr(0, kByteOrderMark.size()) == kByteOrderMark
             ? text.substr(kByteOrderMark.size())
             : text;
}

}  // namespace

std::string_view CsvTable::cell(std::size_t row, std::size_t column) const {
  const std::size_t index = row * columns_.size() + column;
  const std::size_t start = index == 0 ? 0 : ends_[index - 1];
  return std::string_view(cells_).substr(start, ends_[index] - start);
}

CsvTable read_csv(const std::filesystem::path& path, std::vector<std::string>* torn_rows) {
  return parse_csv(read_file(path, kMostBytes), path.string(), torn_rows);
}

CsvTable parse_csv(std::string_view text, const std::string& name,
                   std::vector<std::string>* torn_rows) {
  if (text.size() > kMostBytes)
    throw IoError(name + ": more than " + std::to_string(kMostBytes) + " bytes");
  text = without_mark(text, name);
  CsvTable table;
  table.name_ = name;
  table.cells_.reserve(text.size());
  table.ends_.reserve(
      static_cast<std::size_t>(std::count_if(
          text.begin(), text.end(), [](char c) { return c == ',' || c == '\n' || c == '\r'; })) +
      1);
  table.lines_.reserve(
      static_cast<std::size_t>(
          std::count_if(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; })) +
      1);
  LineCursor lines(text);
  while (const std::optional<std::string_view> line = lines.next()) {
    if (line->size() > kLongestLine)
      fail_at_line(name, lines.line(),
                   "a line of more than " + std::to_string(kLongestLine) + " bytes");
    if (trimmed(*line).empty()) continue;
    if (lines.ended_without_line_end()) {
      if (!torn_rows) fail_at_line(name, lines.line(), std::string(kOpenEnd) + kMendOpenEnd);
      torn_rows->push_back("line " + std::to_string(lines.line()) + ": " + kOpenEnd);
      continue;
    }
    const std::vector<std::string> cells = LineCutter(*line, name, lines.line()).cells();
    const int number = static_cast<int>(lines.line());
    if (table.columns_.empty()) {
      check_columns(cells, name, number);
      table.columns_ = cells;
      table.header_line_ = number;
      continue;
    }
    if (const std::string fault = row_fault(cells, table.columns_.size()); !fault.empty()) {
      if (!torn_rows) fail_at_line(name, number, fault);
      torn_rows->push_back("line " + std::to_string(number) + ": " + fault);
      continue;
    }
    for (const std::string& cell : cells) {
      table.cells_ += cell;
      table.ends_.push_back(static_cast<std::uint32_t>(table.cells_.size()));
    }
    table.lines_.push_back(number);
  }
  if (table.columns_.empty())
    throw IoError(name + ": the file is empty; a header line that names the columns is expected");
  return table;
}

std::optional<std::size_t> find_column(const CsvTable& table, std::string_view column) {
  const auto found = std::find(table.columns().begin(), table.columns().end(), column);
  if (found == table.columns().end()) return std::nullopt;
  return static_cast<std::size_t>(found - table.columns().begin());
}

std::size_t column_index(const CsvTable& table, std::string_view column) {
  if (const std::optional<std::size_t> index = find_column(table, column)) return *index;
  std::string names;
  for (const std::string& other : table.columns()) names += (names.empty() ? "" : ", ") + other;
  fail_at_line(table.name(), table.header_line(),
               "no column " + in_quotes(column) + " among " + in_quotes(names));
}

void fail_at_row(const CsvTable& table, std::size_t row, const std::string& what) {
  fail_at_line(table.name(), table.line(row), what);
}

void fail_at_cell(const CsvTable& table, std::size_t row, std::size_t column,
                  const std::string& rule) {
  fail_at_row(
      table, row,
      "column " + table.columns()[column] + ": " + in_quotes(table.cell(row, column)) + " " + rule);
}

std::optional<double> number_at(const CsvTable& table, std::size_t row, std::size_t column) {
  const std::string_view cell = table.cell(row, column);
  if (cell.empty()) return std::nullopt;
  const ParsedNumber number = parse_number(cell);
  switch (number.status) {
    case NumberStatus::Fine:
      return number.value;
    case NumberStatus::NotANumber:
      fail_at_cell(table, row, column,
                   cell.find(',') == std::string_view::npos
                       ? "is not a number"
                       : "is not a number: decimals take a point");
    case NumberStatus::TooLarge:
      fail_at_cell(table, row, column, "is too large for a double");
    case NumberStatus::Underflow:
      fail_at_cell(table, row, column, "is too small for a double: write 0");
  }
  return std::nullopt;
}

double finite_number_at(const CsvTable& table, std::size_t row, std::size_t column) {
  const std::optional<double> value = number_at(table, row, column);
  if (!value || !std::isfinite(*value)) fail_at_cell(table, row, column, "must be a finite number");
  return *value;
}

std::string csv_line(std::span<const std::string> cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) line += ',';
    std::string cell = cells[i];
    std::replace_if(
        cell.begin(), cell.end(), [](char c) { return c == '\n' || c == '\r' || c == '\0'; }, ' ');
    const bool plain =
        cell.find_first_of(",\"") == std::string::npos && trimmed(cell).size() == cell.size();
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
