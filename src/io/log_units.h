/// Names of columns and of units in a robot's log.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace palpation {

using Units = std::vector<std::pair<std::string, double>>;

/// By name, each with its factor to SI; none for what is no quantity: time, position, depth, force.
const Units& units_of(const std::string& quantity);
/// What a role is measured in; empty for names and plain numbers.
std::string quantity_of(const std::string& role);
std::optional<double> factor_of(const std::string& quantity, const std::string& unit);
/// Of ASCII.
std::string lower(std::string_view text);

/// A header cell as words with underscores between, and the unit that stands in its brackets.
struct Named {
  std::string words, bracketed;
};

Named named(const std::string& column);

}  // namespace palpation
