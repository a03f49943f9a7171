/// Tables as text: one header line that names the columns, then one line a row, commas between cells.
///
/// Strict, so that nothing is misread in silence: every row has as many cells as the header, a name appears once, a cell is a number as a
/// whole or not at all. Cells may be quoted ("" is a quote inside) but hold no line end. LF, CRLF, a byte order mark, blanks around cells
/// and empty lines are welcome; the locale plays no part. Caps: 65,536 bytes a line, 1,024 columns.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palpation {

struct CsvTable {
  std::string name;  ///< of the file, for messages
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< as many cells as columns each
  std::vector<int> lines;                      ///< of each row, counted from 1
};

/// Throws IoError with path, line and rule.
CsvTable read_csv(const std::filesystem::path& path);
/// The same from text; `name` stands for the path in messages.
CsvTable parse_csv(std::string_view text, const std::string& name);

/// The index of a column, or nothing.
std::optional<int> find_column(const CsvTable& table, std::string_view column);
/// The same for a column that must be there. Throws IoError naming it.
int column_index(const CsvTable& table, std::string_view column);

/// Throws IoError("path:line: column ...: value rule") for a cell.
[[noreturn]] void fail_at_cell(const CsvTable& table, int row, std::string_view column, const std::string& rule);

/// A column's numbers: nothing for an empty cell, while "nan" and "inf" are numbers. Throws IoError if the column is missing or a cell is
/// no number.
std::vector<std::optional<double>> numbers(const CsvTable& table, std::string_view column);
/// The same where every row must have a finite number.
std::vector<double> finite_numbers(const CsvTable& table, std::string_view column);

/// One line with its end; cells are quoted where they must be, and line ends in them become blanks.
std::string csv_line(std::span<const std::string> cells);

}  // namespace palpation
