/// Tables as text: one header line that names the columns, then one line a row, commas between
/// cells.
///
/// Strict, so that nothing is misread in silence: every row has as many cells as the header, a name
/// appears once, a cell is a number as a whole or not at all, and the last line has its end:
/// without it 806.0 may have been cut to 8. Cells may be quoted ("" is a quote inside) but hold no
/// line end. LF, CRLF or CR, a byte order mark, blanks around cells and empty lines are welcome;
/// the locale plays no part. Caps: 65,536 bytes a line, 1,024 columns, 1 GiB a file.
///
/// Every error is an IoError "path:line: column ...: value rule".
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palpation {

/// Cells lie one behind the other in one text, so that a table takes little more memory than its
/// file.
class CsvTable {
 public:
  const std::string& name() const { return name_; }  ///< of the file, for messages
  const std::vector<std::string>& columns() const { return columns_; }
  std::size_t row_count() const { return lines_.size(); }
  /// Valid as long as the table.
  std::string_view cell(std::size_t row, std::size_t column) const;
  int line(std::size_t row) const { return lines_[row]; }  ///< of the file, from 1
  int header_line() const { return header_line_; }

 private:
  friend CsvTable parse_csv(std::string_view text, const std::string& name,
                            std::vector<std::string>* torn_rows);

  std::string name_;
  std::vector<std::string> columns_;
  int header_line_ = 0;
  std::string cells_;
  std::vector<std::uint32_t> ends_;  ///< of each cell in cells_, row by row
  std::vector<int> lines_;
};

/// Rows with more or fewer cells than the header, or without their end, are errors or, where the
/// caller gives a place for their messages, left out: a log that was cut off has one at its end.
CsvTable read_csv(const std::filesystem::path& path, std::vector<std::string>* torn_rows = nullptr);
/// The same from text; `name` stands for the path in messages.
CsvTable parse_csv(std::string_view text, const std::string& name,
                   std::vector<std::string>* torn_rows = nullptr);

/// The index of a column, or nothing.
std::optional<std::size_t> find_column(const CsvTable& table, std::string_view column);
/// The same for a column that must be there.
std::size_t column_index(const CsvTable& table, std::string_view column);

[[noreturn]] void fail_at_row(const CsvTable& table, std::size_t row, const std::string& what);
[[noreturn]] void fail_at_cell(const CsvTable& table, std::size_t row, std::size_t column,
                               const std::string& rule);

/// A cell as a number: nothing if it is empty, while "nan" and "inf" are numbers. Too large or too
/// small for a double is an error.
std::optional<double> number_at(const CsvTable& table, std::size_t row, std::size_t column);
/// The same where there must be a finite number.
double finite_number_at(const CsvTable& table, std::size_t row, std::size_t column);

/// One line with its end; cells are quoted where they must be, and line ends in them become blanks.
std::string csv_line(std::span<const std::string> cells);

}  // namespace palpation
