/// SHA-256 (FIPS 180-4): what a file was, in a form that sha256sum tells, too.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace palpation::results {

std::array<std::uint8_t, 32> sha256(std::string_view bytes);

/// 64 hexadecimal digits.
std::string sha256_digits(std::string_view bytes);

/// Any bytes as text, RFC 4648 with padding.
std::string base64(std::string_view bytes);

}  // namespace palpation::results
