/// JSON of a scene, read without trust: no duplicate keys, no nesting that no scene needs, and
/// every error with its place.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "palpation/base/error.h"

namespace palpation::tool {

/// A number in JSON that no double holds.
class NumberTooLarge : public IoError {
 public:
  using IoError::IoError;
};

/// Throws IoError: "<name>:<line>:<column>: ..." where the text is not JSON (NumberTooLarge where
/// it is, but holds such a number), "<name>: <key>: ..." where a key stands twice or values nest
/// deeper than 32 levels. A byte order mark is welcome.
nlohmann::json parse_json(std::string_view text, const std::string& name);

/// The same of a file of at most 16 MiB; throws IoError too where it cannot be read.
nlohmann::json read_json(const std::filesystem::path& path);

/// A value for a message: plain ASCII, and no more than a few words of it.
std::string shown(const nlohmann::json& value);
/// The same for a text that is not quoted, such as a key.
std::string shown_key(std::string_view key);

}  // namespace palpation::tool
