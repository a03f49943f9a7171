/// A table from a CSV file whose columns may be missing, and whose cells may be empty.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "palpation/io/csv.h"

namespace palpation::draw {

class Table {
 public:
  /// As read_csv. Throws IoError.
  explicit Table(const std::filesystem::path& path) : table_(read_csv(path)) {}

  const std::vector<std::string>& names() const { return table_.columns(); }
  int row_count() const { return static_cast<int>(table_.row_count()); }
  bool has(const std::string& name) const { return find_column(table_, name).has_value(); }

  /// Cells as they are; all empty if there is no such column.
  std::vector<std::string> texts(const std::string& name) const;
  /// Cells as numbers, NaN where empty; all NaN if there is no such column. Throws IoError with
  /// path, line and column for any other text.
  std::vector<double> numbers(const std::string& name) const;

 private:
  CsvTable table_;
};

}  // namespace palpation::draw
