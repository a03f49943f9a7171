/// What can go wrong, and whose fault it is. A normal outcome (no contact, nothing stiff found) is
/// a value, never one of these.
#pragma once

#include <stdexcept>
#include <string>

namespace palpation {

/// Root of all errors that the library throws on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The caller broke a contract: the message names the function, the value and the rule.
class InvalidInput : public Error {
 public:
  using Error::Error;
};

/// A file is at fault: the message names the path, the line or byte where that is known, and the
/// rule.
class IoError : public Error {
 public:
  using Error::Error;
};

/// A file could not be written, though what it was to hold is sound: the machine is at fault, not
/// the input.
class WriteError : public IoError {
 public:
  using IoError::IoError;
};

/// A mesh is no surface: the message names the element, its position and the rule.
class InvalidMesh : public Error {
 public:
  using Error::Error;
};

/// The arithmetic failed: the message names the step and the quantity.
class NumericalError : public Error {
 public:
  using Error::Error;
};

/// Throws InvalidInput("<function>: <value> <rule>") unless the condition holds.
void require(bool condition, const std::string& function, const std::string& value,
             const std::string& rule);

/// A number for a message: shortest text that reads back as the same double.
std::string text_of(double value);

}  // namespace palpation
