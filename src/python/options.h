/// Keyword arguments by their names, with defaults and words.
#pragma once

#include <pybind11/pybind11.h>

#include <span>
#include <string>

#include "palpation/base/error.h"
#include "palpation/base/learnable.h"

namespace palpation::python {

template <typename Choice>
struct Word {
  const char* text;
  Choice choice;
};

/// Numbers are finite. All throw TypeError for a value of another type and InvalidInput for a value
/// that breaks a rule, naming class, argument and value.
class Options {
 public:
  /// Throws TypeError for a keyword that has no default, naming those that there are.
  Options(const char* of, const pybind11::dict& defaults, const pybind11::kwargs& given);

  pybind11::object operator[](const char* name) const { return values_[name]; }
  double number(const char* name) const;
  int integer(const char* name) const;
  std::uint64_t seed(const char* name) const;
  bool truth(const char* name) const;
  std::string text(const char* name) const;
  Learnable learnable(const char* name) const;  ///< a number or "learn"

  template <typename Choice>
  Choice choice(const char* name, std::span<const Word<Choice>> words) const {
    const std::string given = text(name);
    std::string all;
    for (const Word<Choice>& word : words) {
      if (given == word.text) return word.choice;
      all += (all.empty() ? "'" : ", '") + std::string(word.text) + "'";
    }
    throw InvalidInput(std::string(of_) + ": " + name + " '" + given + "' must be one of " + all);
  }

 private:
  [[noreturn]] void refuse_type(const char* name, const char* rule) const;

  const char* of_;
  pybind11::dict values_;
};

/// The word for a choice.
template <typename Choice>
const char* word_for(Choice choice, std::span<const Word<Choice>> words) {
  for (const Word<Choice>& word : words) {
    if (choice == word.choice) return word.text;
  }
  return "";
}

pybind11::object value_of(const Learnable& learnable);

/// "Model(metric='chart', ...)".
std::string call_text(const char* of, const pybind11::dict& values);

}  // namespace palpation::python
