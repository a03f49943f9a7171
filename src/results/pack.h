/// Numbers as text for a page: few bytes each, and known how far off they may be.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "palpation/base/types.h"

namespace palpation::results {

/// {"bits", "low", "high", "values"}: 8 or 16 bits are whole steps from low to high, each off by
/// half a step at most; 32 are floats as they are. What is no number becomes the lowest.
nlohmann::json packed(std::span<const double> values, int bits);

/// Places as three steps each of 65,535 from the box's lowest to its highest corner.
class PlaceGrid {
 public:
  PlaceGrid(Vec3 low, Vec3 high) : low_(std::move(low)), high_(std::move(high)) {}
  void add(const Vec3& place, std::string& bytes) const;
  std::string text(std::span<const Vec3> places) const;

 private:
  Vec3 low_, high_;
};

/// Whole numbers of 2 or 4 bytes, the lowest byte first.
std::string packed_indices(std::span<const int> indices, int bytes_each);

/// The value that a share of the others does not exceed; 0 where there is none. What is no number
/// does not count.
double quantile(std::vector<double> values, double share);

}  // namespace palpation::results
