#include "results/pack.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "results/sha256.h"

namespace palpation::results {
namespace {

void add_bytes(std::uint32_t value, int count, std::string& bytes) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 255u);
}

std::uint32_t step_of(double value, double low, double high, double most) {
  if (!(high > low) || !std::isfinite(value)) return 0;
  return static_cast<std::uint32_t>(
      std::lround(std::clamp((value - low) / (high - low), 0.0, 1.0) * most));
}

}  // namespace

nlohmann::json packed(std::span<const double> values, int bits) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (!(low <= high)) low = high = 0.0;
  std::string bytes;
  for (const double value : values) {
    if (bits == 32) {
      add_bytes(
          std::bit_cast<std::uint32_t>(static_cast<float>(std::isfinite(value) ? value : low)), 4,
          bytes);
    } else {
      add_bytes(step_of(value, low, high, bits == 16 ? 65535.0 : 255.0), bits / 8, bytes);
    }
  }
  return {{"bits", bits}, {"low", low}, {"high", high}, {"values", base64(bytes)}};
}

void PlaceGrid::add(const Vec3& place, std::string& bytes) const {
  for (int i = 0; i < 3; ++i) add_bytes(step_of(place[i], low_[i], high_[i], 65535.0), 2, bytes);
}

std::string PlaceGrid::text(std::span<const Vec3> places) const {
  std::string bytes;
  for (const Vec3& place : places) add(place, bytes);
  return base64(bytes);
}

std::string packed_indices(std::span<const int> indices, int bytes_each) {
  std::string bytes;
  for (const int index : indices) add_bytes(static_cast<std::uint32_t>(index), bytes_each, bytes);
  return base64(bytes);
}

double quantile(std::vector<double> values, double share) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(
                                       std::lround(share * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace palpation::results
