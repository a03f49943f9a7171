#include <algorithm>
#include <cstdint>
#include <utility>

#include "geometry/surface_state.h"
#include "palpation/geometry/surface.h"

namespace palpation {
namespace {

constexpr int kBits = 21;  // of a coordinate: three make a number of 63

/// Every third bit of the result is one of the value's.
std::uint64_t spread(std::uint64_t value) {
  constexpr std::pair<int, std::uint64_t> kSteps[] = {{32, 0x1f00000000ffff},
                                                      {16, 0x1f0000ff0000ff},
                                                      {8, 0x100f00f00f00f00f},
                                                      {4, 0x10c30c30c30c30c3},
                                                      {2, 0x1249249249249249}};
  for (const auto& [shift, mask] : kSteps) value = (value | value << shift) & mask;
  return value;
}

std::vector<int> along_mortons_curve(const Points& points) {
  const Eigen::RowVector3d corner = points.colwise().minCoeff();
  const double extent = (points.colwise().maxCoeff() - corner).maxCoeff();
  const double cells = extent > 0.0 ? static_cast<double>((1 << kBits) - 1) / extent : 0.0;
  std::vector<std::pair<std::uint64_t, int>> codes(static_cast<std::size_t>(points.rows()));
  for (std::size_t i = 0; i < codes.size(); ++i) {
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double cell = (points(static_cast<Eigen::Index>(i), axis) - corner[axis]) * cells;
      code |= spread(static_cast<std::uint64_t>(
                  std::clamp(cell, 0.0, static_cast<double>((1 << kBits) - 1))))
              << axis;
    }
    codes[i] = {code, static_cast<int>(i)};
  }
  std::sort(codes.begin(), codes.end());
  std::vector<int> order;
  order.reserve(codes.size());
  for (const auto& [code, vertex] : codes) order.push_back(vertex);
  return order;
}

}  // namespace

const std::vector<int>& Surface::locality_order() const {
  std::call_once(state_->order_once,
                 [&] { state_->locality_order = along_mortons_curve(state_->mesh.vertices); });
  return state_->locality_order;
}

}  // namespace palpation
