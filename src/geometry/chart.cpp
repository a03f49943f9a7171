#include "palpation/geometry/chart.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>

namespace palpation {
namespace {

constexpr double kNanometre = 1e-9;

/// The coordinate in nanometres; beyond 64 bits (charts of nine million kilometres), the bits of
/// the double.
std::uint64_t rounded(double coordinate_m) {
  const double nanometres = std::round(coordinate_m / kNanometre);
  if (std::abs(nanometres) < 0x1p63)
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(nanometres));
  return std::bit_cast<std::uint64_t>(coordinate_m);
}

}  // namespace

std::string Chart::hash() const {
  std::uint64_t state = 0xcbf29ce484222325u;  // FNV-1a, 64 bits, bytes from the lowest
  for (Eigen::Index i = 0; i < uv.size(); ++i) {
    const std::uint64_t word = rounded(uv.data()[i]);
    for (int shift = 0; shift < 64; shift += 8)
      state = (state ^ ((word >> shift) & 0xffu)) * 0x100000001b3u;
  }
  std::array<char, 16> digits{};
  const auto [end, status] = std::to_chars(digits.data(), digits.data() + digits.size(), state, 16);
  const std::string text(digits.data(), end);
  return std::string(16 - text.size(), '0') + text;
}

}  // namespace palpation
