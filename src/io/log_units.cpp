#include "io/log_units.h"

#include <algorithm>
#include <cctype>

namespace palpation {

const Units& units_of(const std::string& quantity) {
  static const Units times = {{"s", 1.0},     {"sec", 1.0},   {"secs", 1.0}, {"seconds", 1.0},
                              {"ms", 1e-3},   {"us", 1e-6},   {"ns", 1e-9},  {"min", 60.0},
                              {"nsec", 1e-9}, {"nsecs", 1e-9}};
  static const Units lengths = {{"mm", 1e-3},          {"cm", 1e-2},        {"m", 1.0},
                                {"um", 1e-6},          {"micron", 1e-6},    {"microns", 1e-6},
                                {"metres", 1.0},       {"meters", 1.0},     {"millimetres", 1e-3},
                                {"millimeters", 1e-3}, {"\xC2\xB5m", 1e-6}, {"\xCE\xBCm", 1e-6}};
  static const Units forces = {{"n", 1.0},         {"mn", 1e-3},     {"un", 1e-6},
                               {"kn", 1e3},        {"newton", 1.0},  {"newtons", 1.0},
                               {"gf", 9.80665e-3}, {"kgf", 9.80665}, {"counts", 1.0},
                               {"count", 1.0},     {"cts", 1.0}};
  static const Units none = {};
  if (quantity == "time") return times;
  if (quantity == "position" || quantity == "depth") return lengths;
  return quantity == "force" ? forces : none;
}

std::string quantity_of(const std::string& role) {
  if (role == "time" || role == "depth") return role;
  if (role == "x" || role == "y" || role == "z" || role.starts_with("contact_")) return "position";
  return role == "force" || role == "fx" || role == "fy" || role == "fz" ? "force" : "";
}

std::string lower(std::string_view text) {
  std::string low;
  for (const char c : text) low += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return low;
}

Named named(const std::string& column) {
  Named result;
  std::string text = lower(column);
  const std::size_t open = text.find_first_of("[(");
  const std::size_t close = text.find_first_of(")]", open == std::string::npos ? 0 : open);
  if (open != std::string::npos && close != std::string::npos && close > open + 1) {
    const std::string inside = text.substr(open + 1, close - open - 1);
    if (!std::all_of(inside.begin(), inside.end(), [](unsigned char c) { return std::isdigit(c); }))
      result.bracketed = inside;
    text = text.substr(0, open) + "_" + text.substr(close + 1);
  }
  for (const char c : text) {
    const bool separates = c == ' ' || c == '.' || c == '/' || c == '-' || c == ':' || c == '_';
    if (!separates) result.words += c;
    if (separates && !result.words.empty() && result.words.back() != '_') result.words += '_';
  }
  if (result.words.ends_with('_')) result.words.pop_back();
  return result;
}

std::optional<double> factor_of(const std::string& quantity, const std::string& unit) {
  for (const auto& [name, factor] : units_of(quantity))
    if (name == unit) return factor;
  return std::nullopt;
}

}  // namespace palpation
