/// One row of an experiment's results: which trial it is of, and its figures by name.
///
/// A figure is kept as the text that the file holds, so that a table made while the trials run and
/// one made from their files are the same bytes.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace palpation::tool {

/// What a row is of: a trial of a cell. A trial may give several rows, which are numbered.
struct RowKey {
  std::size_t cell = 0;  ///< by its place among the experiment's cells
  std::uint64_t seed = 0;
  std::size_t part = 0;

  auto operator<=>(const RowKey&) const = default;
};

/// Figures by their names. What ends with "_s" (seconds) or "_mb" (memory) is the machine's and
/// differs from run to run; the rest follows from scene and seed.
class Figures {
 public:
  Figures& set(const std::string& name, double value);
  Figures& set(const std::string& name,
               const std::optional<double>& value);  ///< empty if there is none
  Figures& set(const std::string& name, const std::string& word);
  Figures& set(const std::string& name, const char* word);
  Figures& set(const std::string& name, bool flag);  ///< 1 or 0

  bool has(const std::string& name) const { return texts_.contains(name); }
  /// Empty if there is none of this name.
  const std::string& word(const std::string& name) const;
  /// Throws InvalidInput unless there is a number of this name.
  double number(const std::string& name) const;
  std::optional<double> maybe_number(const std::string& name) const;  ///< nothing if it is empty
  bool flag(const std::string& name) const { return number(name) != 0.0; }

  const std::map<std::string, std::string>& texts() const { return texts_; }

 private:
  std::map<std::string, std::string> texts_;
};

struct Row {
  RowKey key{};
  Figures figures{};
};

/// Whether a figure is the machine's: a time, or memory.
bool is_of_the_machine(const std::string& name);

}  // namespace palpation::tool
