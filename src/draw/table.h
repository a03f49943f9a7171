/// A table from a CSV file: a line of names, then rows of cells, any of which may be empty.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palpation::draw {

class Table {
 public:
  /// Cells are separated by commas; one that holds commas stands in double quotes, "" within it
  /// means ". Empty lines are skipped. Throws IoError with path and line if the file cannot be
  /// read, has no header, or a row has another number of cells than the header.
  explicit Table(const std::filesystem::path& path);

  const std::vector<std::string>& names() const { return names_; }
  int row_count() const { return static_cast<int>(rows_.size()); }
  bool has(const std::string& name) const { return index_of(name).has_value(); }

  /// Cells as they are; all empty if there is no such column.
  std::vector<std::string> texts(const std::string& name) const;
  /// Cells as numbers, NaN where empty; all NaN if there is no such column. Throws IoError with
  /// path, line and column for any other text.
  std::vector<double> numbers(const std::string& name) const;

 private:
  std::optional<std::size_t> index_of(const std::string& name) const;

  std::filesystem::path path_;
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> rows_;
  std::vector<int> lines_;  // of each row, in the file
};

}  // namespace palpation::draw
