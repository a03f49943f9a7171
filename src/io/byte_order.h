/// Numbers in binary files, by byte order and not by the machine's.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>

namespace palpation {

enum class ByteOrder { Little, Big };

/// The number at the front of the bytes, which must be long enough.
template <typename Number>
Number number_from(std::string_view bytes, ByteOrder order) {
  std::array<char, sizeof(Number)> raw;
  std::copy_n(bytes.begin(), raw.size(), raw.begin());
  const bool native = (order == ByteOrder::Little) == (std::endian::native == std::endian::little);
  if (!native) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<Number>(raw);
}

template <typename Number>
void append_little_endian(std::string& bytes, Number number) {
  auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  if (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

}  // namespace palpation
