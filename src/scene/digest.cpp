#include "scene/digest.h"

#include <array>
#include <charconv>
#include <cstdint>

#include "palpation/io/atomic_file.h"

namespace palpation::tool {
namespace {

/// FNV-1a, 64 bits.
class Digest {
 public:
  void add(std::string_view bytes) {
    for (const char byte : bytes)
      state_ = (state_ ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  }
  std::string text() const {
    std::array<char, 16> digits{};
    const auto [end, status] =
        std::to_chars(digits.data(), digits.data() + digits.size(), state_, 16);
    const std::string text(digits.data(), end);
    return std::string(digits.size() - text.size(), '0') + text;
  }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

template <typename Matrix>
std::string_view bytes_of(const Matrix& matrix) {
  return {reinterpret_cast<const char*>(matrix.data()),
          static_cast<std::size_t>(matrix.size()) * sizeof(typename Matrix::Scalar)};
}

}  // namespace

std::string digest(std::string_view bytes) {
  Digest digest;
  digest.add(bytes);
  return digest.text();
}

std::string digest(const TriangleMesh& mesh) {
  Digest digest;
  digest.add(std::to_string(mesh.vertices.rows()) + " ");
  digest.add(bytes_of(mesh.vertices));
  digest.add(bytes_of(mesh.triangles));
  return digest.text();
}

/// Objects of this type keep their keys in order.
std::string json_digest(const nlohmann::json& value) {
  return digest(value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

std::string program_digest() {
  static const std::string of_this = digest(read_file("/proc/self/exe"));
  return of_this;
}

}  // namespace palpation::tool
