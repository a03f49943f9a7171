#include "draw/table.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"

namespace palpation::draw {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int line, const std::string& reason) {
  throw IoError(path.string() + ": line " + std::to_string(line) + ": " + reason);
}

std::vector<std::string> lines_of(const std::string& bytes) {
  std::vector<std::string> lines(1);
  for (const char c : bytes) {
    if (c == '\n') {
      lines.emplace_back();
    } else if (c != '\r') {
      lines.back().push_back(c);
    }
  }
  return lines;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back().push_back(line[++i]);
    } else if (line[i] == '"') {
      quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back().push_back(line[i]);
    }
  }
  return cells;
}

}  // namespace

Table::Table(const std::filesystem::path& path) : path_(path) {
  const std::vector<std::string> lines = lines_of(read_file(path));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].empty()) continue;
    std::vector<std::string> cells = cells_of(lines[i]);
    const int number = static_cast<int>(i) + 1;
    if (names_.empty()) {
      names_ = std::move(cells);
      continue;
    }
    if (cells.size() != names_.size()) {
      fail(path, number,
           std::to_string(cells.size()) + " cells, but the header names " +
               std::to_string(names_.size()));
    }
    rows_.push_back(std::move(cells));
    lines_.push_back(number);
  }
  if (names_.empty()) fail(path, 1, "no header");
}

std::vector<std::string> Table::texts(const std::string& name) const {
  std::vector<std::string> result(rows_.size());
  const auto column = index_of(name);
  if (!column) return result;
  std::transform(rows_.begin(), rows_.end(), result.begin(),
                 [&](const auto& row) { return row[*column]; });
  return result;
}

std::vector<double> Table::numbers(const std::string& name) const {
  std::vector<double> result;
  const std::vector<std::string> cells = texts(name);
  for (std::size_t row = 0; row < cells.size(); ++row) {
    double value = std::numeric_limits<double>::quiet_NaN();
    const char* end = cells[row].data() + cells[row].size();
    const auto [stopped, error] = std::from_chars(cells[row].data(), end, value);
    if (!cells[row].empty() && (error != std::errc() || stopped != end)) {
      fail(path_, lines_[row],
           "column " + name + ": '" + cells[row].substr(0, 40) + "' is no number");
    }
    result.push_back(value);
  }
  return result;
}

std::optional<std::size_t> Table::index_of(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names_.begin());
}

}  // namespace palpation::draw
