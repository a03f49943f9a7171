#include "io/log_columns.h"

#include <algorithm>
#include <utility>

#include "io/log_units.h"
#include "io/number_text.h"
#include "palpation/base/error.h"
#include "palpation/io/csv.h"

namespace palpation {
namespace {

bool is_known_as(const std::string& words, const std::vector<std::string>& aliases) {
  return std::any_of(aliases.begin(), aliases.end(), [&](const std::string& alias) {
    // A topic's name may stand before a name of several words: psm1_measured_cp_pose_position_x.
    return words == alias || (alias.find('_') != std::string::npos && words.ends_with("_" + alias));
  });
}

/// The unit that a column's name ends in, where what is left names the role.
std::optional<std::string> unit_in(const Named& column, const std::string& role,
                                   const std::vector<std::string>& aliases) {
  if (is_known_as(column.words, aliases)) return column.bracketed;
  const std::size_t last = column.words.rfind('_');
  if (last == std::string::npos || !column.bracketed.empty()) return std::nullopt;
  const std::string unit = column.words.substr(last + 1);
  const bool is_unit = factor_of(quantity_of(role), unit).has_value();
  if (is_unit && is_known_as(column.words.substr(0, last), aliases)) return unit;
  return std::nullopt;
}

[[noreturn]] void fail_at_header(const CsvTable& table, const std::string& words) {
  throw IoError(table.name() + ":" + std::to_string(table.header_line()) + ": " + words);
}

class Finder {
 public:
  Finder(const CsvTable& table, const LogRules& rules) : table_(table), rules_(rules) {
    for (const std::string& column : table.columns()) named_.push_back(named(column));
  }

  std::map<std::string, LogColumn> find() const {
    std::map<std::string, LogColumn> found;
    for (const auto& [role, aliases] : log_roles()) {
      if (const auto column = column_of(role, aliases)) found.emplace(role, *column);
    }
    take_one_force(found);
    return found;
  }

 private:
  std::optional<LogColumn> column_of(const std::string& role,
                                     const std::vector<std::string>& aliases) const {
    if (const auto given = rules_.columns.find(role); given != rules_.columns.end()) {
      const std::size_t index = column_index(table_, given->second);
      const Named& column = named_[index];
      const std::size_t last = column.words.rfind('_');
      std::string unit = column.bracketed;
      if (unit.empty() && last != std::string::npos &&
          factor_of(quantity_of(role), column.words.substr(last + 1)))
        unit = column.words.substr(last + 1);
      return with_unit(role, index, unit);
    }
    std::vector<std::pair<std::size_t, std::string>> candidates;
    for (std::size_t i = 0; i < named_.size(); ++i) {
      if (is_taken(i)) continue;
      if (const auto unit = unit_in(named_[i], role, aliases)) candidates.emplace_back(i, *unit);
    }
    if (candidates.empty()) return std::nullopt;
    if (candidates.size() > 1) {
      std::string names;
      for (const auto& [index, unit] : candidates)
        names += (names.empty() ? "" : ", ") + in_quotes(table_.columns()[index]);
      fail_at_header(table_, "more than one column could be " + role + ": " + names +
                                 "; say which: --column " + role + "=NAME");
    }
    return with_unit(role, candidates[0].first, candidates[0].second);
  }

  /// By the rules, for whatever role.
  bool is_taken(std::size_t index) const {
    return std::any_of(rules_.columns.begin(), rules_.columns.end(),
                       [&](const auto& rule) { return rule.second == table_.columns()[index]; });
  }

  LogColumn with_unit(const std::string& role, std::size_t index, std::string unit) const {
    const std::string quantity = quantity_of(role), name = in_quotes(table_.columns()[index]);
    if (quantity.empty()) return {.index = index};
    const auto given = rules_.units.find(quantity);
    if (given != rules_.units.end()) {
      if (!unit.empty() && factor_of(quantity, unit) != factor_of(quantity, lower(given->second)))
        fail_at_header(table_, "column " + name + " is in " + unit + " by its name, but --unit " +
                                   quantity + "=" + given->second + " says otherwise");
      unit = lower(given->second);
    }
    std::string units;
    for (const auto& [known, factor] : units_of(quantity)) {
      if (units.size() < 20) units += (units.empty() ? "" : ", ") + known;
    }
    if (unit.empty())
      fail_at_header(table_, "column " + name + " (" + role +
                                 ") has no unit in its name: say --unit " + quantity + "=" +
                                 (quantity == "time"    ? "s"
                                  : quantity == "force" ? "N"
                                                        : "mm") +
                                 ", or what it is in");
    const std::optional<double> factor = factor_of(quantity, unit);
    if (!factor)
      fail_at_header(table_, "column " + name + " (" + role + "): " + in_quotes(unit) +
                                 " is no unit that is known of " + quantity + ": " + units);
    return {.index = index, .factor = *factor, .unit = unit};
  }

  /// A force along the normal, components, or counts: one of them.
  void take_one_force(std::map<std::string, LogColumn>& found) const {
    const bool along = found.contains("force"), count = found.contains("count"),
               components = found.contains("fx") || found.contains("fy") || found.contains("fz");
    const auto named_by_rule = [&](const std::string& role) {
      return rules_.columns.contains(role);
    };
    const auto drop = [&](std::initializer_list<const char*> roles) {
      for (const char* role : roles) found.erase(role);
    };
    if (along + count + components <= 1) return;
    if (named_by_rule("force")) return drop({"count", "fx", "fy", "fz"});
    if (named_by_rule("fx")) return drop({"count", "force"});
    if (named_by_rule("count")) return drop({"force", "fx", "fy", "fz"});
    std::string names;
    for (const char* role : {"force", "fx", "fy", "fz", "count"}) {
      if (found.contains(role))
        names += (names.empty() ? "" : ", ") + in_quotes(table_.columns()[found.at(role).index]);
    }
    fail_at_header(table_, "more than one column could be the force: " + names +
                               "; say which: --column force=NAME, fx=NAME or count=NAME");
  }

  const CsvTable& table_;
  const LogRules& rules_;
  std::vector<Named> named_;
};

void check(const LogRules& rules) {
  const auto& roles = log_roles();
  for (const auto& [role, column] : rules.columns) {
    const bool is_role = std::any_of(roles.begin(), roles.end(),
                                     [&](const auto& known) { return known.first == role; });
    require(is_role, "read_robot_log", in_quotes(role), "is no role of a column");
  }
  for (const auto& [quantity, unit] : rules.units) {
    require(!units_of(quantity).empty(), "read_robot_log", in_quotes(quantity),
            "is no quantity: time, position, depth or force");
    require(factor_of(quantity, lower(unit)).has_value(), "read_robot_log", in_quotes(unit),
            "is no unit that is known of " + quantity);
  }
}

/// What the first line may be instead of one that names the columns.
std::string hint_at(const CsvTable& table) {
  return table.columns().front().starts_with('#')
             ? "; or is the line that begins with # a comment? Take it away"
             : "";
}

}  // namespace

std::map<std::string, LogColumn> log_columns(const CsvTable& table, const LogRules& rules) {
  check(rules);
  std::map<std::string, LogColumn> found = Finder(table, rules).find();
  const auto need = [&](const std::string& role, const std::string& hint) {
    if (found.contains(role)) return;
    std::string names;
    for (const std::string& column : table.columns()) names += (names.empty() ? "" : ", ") + column;
    fail_at_header(table, "no column for " + hint + " among " + in_quotes(names) +
                              ": name it with --column " + role + "=NAME" + hint_at(table));
  };
  need("x", "the position x");
  need("y", "the position y");
  const bool components = found.contains("fx") || found.contains("fy") || found.contains("fz");
  if (components)
    for (const char* role : {"fx", "fy", "fz"})
      need(role, "the force's component " + std::string(role));
  else if (!found.contains("count"))
    need("force", "the force");
  for (const char* first : {"n", "contact_"}) {
    const std::string start = first;
    const int count = int(found.contains(start + "x")) + int(found.contains(start + "y")) +
                      int(found.contains(start + "z"));
    if (count > 0 && count < 3)
      for (const char* axis : {"x", "y", "z"})
        need(start + axis, start + axis + ", as others of its kind are there,");
  }
  return found;
}

std::string columns_words(const CsvTable& table, const std::map<std::string, LogColumn>& columns) {
  std::string words;
  for (const auto& [role, aliases] : log_roles()) {
    const auto column = columns.find(role);
    if (column == columns.end()) continue;
    words += (words.empty() ? "" : ", ") + role + " = " + table.columns()[column->second.index];
    if (!column->second.unit.empty()) words += " [" + column->second.unit + "]";
  }
  return words;
}

}  // namespace palpation
