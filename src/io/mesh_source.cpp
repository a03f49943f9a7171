#include "io/mesh_source.h"

#include "palpation/base/error.h"

namespace palpation {

void MeshSource::fail(const std::string& what) const { throw IoError(path.string() + ": " + what); }

void MeshSource::fail_at_line(std::int64_t line, const std::string& what) const {
  throw IoError(path.string() + ":" + std::to_string(line) + ": " + what);
}

void MeshSource::fail_at_byte(std::size_t byte, const std::string& what) const {
  throw IoError(path.string() + ", byte " + std::to_string(skipped + byte) + ": " + what);
}

void MeshSource::refuse_nul_bytes() const {
  const std::size_t nul = bytes.find('\0');
  if (nul != std::string_view::npos) fail_at_byte(nul, "a NUL byte has no place in a text file");
}

}  // namespace palpation
