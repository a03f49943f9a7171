#include "draw/table.h"

#include <limits>

namespace palpation::draw {

std::vector<std::string> Table::texts(const std::string& name) const {
  std::vector<std::string> result(table_.row_count());
  const std::optional<std::size_t> column = find_column(table_, name);
  for (std::size_t row = 0; column && row < result.size(); ++row)
    result[row] = table_.cell(row, *column);
  return result;
}

std::vector<double> Table::numbers(const std::string& name) const {
  std::vector<double> result(table_.row_count(), std::numeric_limits<double>::quiet_NaN());
  const std::optional<std::size_t> column = find_column(table_, name);
  for (std::size_t row = 0; column && row < result.size(); ++row)
    result[row] = number_at(table_, row, *column).value_or(result[row]);
  return result;
}

}  // namespace palpation::draw
