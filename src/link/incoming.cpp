#include "link/incoming.h"

#include <algorithm>
#include <optional>

#include "link/messages.h"

namespace palpation::link {
namespace {

// The header's fields (OpenIGTLink protocol, version 1 to 3), all big-endian: version, type and
// device of 12 and 20 bytes, time, size of the body, its CRC.
constexpr std::size_t kType = 2, kDevice = 14, kSize = 42;
constexpr std::uint64_t kLatestVersion = 3;
constexpr std::uint64_t kLargestBody = std::uint64_t{1} << 40;

std::uint64_t number_at(std::string_view header, std::size_t place, std::size_t bytes) {
  std::uint64_t number = 0;
  for (const char byte : header.substr(place, bytes))
    number = number << 8 | static_cast<unsigned char>(byte);
  return number;
}

/// Up to the first NUL.
std::string name_at(std::string_view header, std::size_t place, std::size_t bytes) {
  const std::string_view field = header.substr(place, bytes);
  return std::string(field.substr(0, field.find('\0')));
}

bool is_word(char byte) {
  return (byte >= 'A' && byte <= 'Z') || (byte >= 'a' && byte <= 'z') ||
         (byte >= '0' && byte <= '9') || byte == '_';
}

struct Header {
  Heard heard;
  std::uint64_t body_bytes = 0;
};

std::optional<Header> parsed(std::string_view bytes) {
  const std::uint64_t version = number_at(bytes, 0, kType);
  Header header{{name_at(bytes, kType, kDevice - kType), name_at(bytes, kDevice, 20)},
                number_at(bytes, kSize, 8)};
  const bool is_one = version >= 1 && version <= kLatestVersion && !header.heard.type.empty() &&
                      std::ranges::all_of(header.heard.type, is_word) &&
                      header.body_bytes <= kLargestBody;
  return is_one ? std::optional(header) : std::nullopt;
}

}  // namespace

std::vector<Heard> Incoming::take(std::string_view bytes) {
  std::vector<Heard> heard;
  while (!bytes.empty() && !is_garbage_) {
    const std::size_t passed =
        static_cast<std::size_t>(std::min<std::uint64_t>(body_bytes_, bytes.size()));
    bytes.remove_prefix(passed);
    body_bytes_ -= passed;
    const std::size_t more = std::min(kHeader_bytes - header_.size(), bytes.size());
    header_ += bytes.substr(0, more);
    bytes.remove_prefix(more);
    if (header_.size() < kHeader_bytes) continue;
    const std::optional<Header> header = parsed(header_);
    header_.clear();
    is_garbage_ = !header;
    if (is_garbage_) break;
    body_bytes_ = header->body_bytes;
    heard.push_back(header->heard);
  }
  return heard;
}

}  // namespace palpation::link
