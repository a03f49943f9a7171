/// The bytes of a mesh file, and how to say what is wrong with them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace palpation {

struct MeshSource {
  std::filesystem::path path;
  std::string_view bytes;
  std::size_t skipped = 0;  ///< bytes of the file in front of them, a byte order mark

  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail_at_line(std::int64_t line, const std::string& what) const;
  [[noreturn]] void fail_at_byte(std::size_t byte, const std::string& what) const;
  /// Text holds no NUL bytes; one that does is damaged, or binary under a wrong name.
  void refuse_nul_bytes() const;
};

}  // namespace palpation
