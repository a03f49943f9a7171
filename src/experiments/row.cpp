#include "experiments/row.h"

#include <charconv>

#include "palpation/base/error.h"

namespace palpation::tool {

Figures& Figures::set(const std::string& name, double value) { return set(name, text_of(value)); }

Figures& Figures::set(const std::string& name, const std::optional<double>& value) {
  return set(name, value ? text_of(*value) : std::string());
}

Figures& Figures::set(const std::string& name, const std::string& word) {
  texts_[name] = word;
  return *this;
}

Figures& Figures::set(const std::string& name, const char* word) {
  return set(name, std::string(word));
}

Figures& Figures::set(const std::string& name, bool flag) { return set(name, flag ? "1" : "0"); }

const std::string& Figures::word(const std::string& name) const {
  static const std::string none;
  const auto found = texts_.find(name);
  return found == texts_.end() ? none : found->second;
}

std::optional<double> Figures::maybe_number(const std::string& name) const {
  const std::string& text = word(name);
  if (text.empty()) return std::nullopt;
  double value = 0.0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  require(status == std::errc{} && end == text.data() + text.size(), "Figures::number",
          name + " = '" + text + "'", "is no number");
  return value;
}

double Figures::number(const std::string& name) const {
  const std::optional<double> value = maybe_number(name);
  require(value.has_value(), "Figures::number", name, "is empty");
  return *value;
}

bool is_of_the_machine(const std::string& name) {
  return name.ends_with("_s") || name.ends_with("_mb");
}

}  // namespace palpation::tool
