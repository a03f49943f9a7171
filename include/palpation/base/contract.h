/// A broken contract as data: for whoever answers it in words of its own.
///
///     catch (const BrokenContract& error) { mark_red(error.value()); tell(error.rule()); }
#pragma once

#include <string>

#include "palpation/base/error.h"

namespace palpation {

/// What `require` throws; what() is "<function>: <value> <rule>".
class BrokenContract : public InvalidInput {
 public:
  BrokenContract(std::string function, std::string value, std::string rule);

  const std::string& function() const { return function_; }  ///< "Robot"
  const std::string& value() const { return value_; }        ///< "standoff_m = -1"
  const std::string& rule() const { return rule_; }          ///< "must not be negative"

 private:
  std::string function_, value_, rule_;
};

/// "<value> <rule>", without the function, where that is known; else all that the error says.
std::string rule_words(const InvalidInput& error);

}  // namespace palpation
