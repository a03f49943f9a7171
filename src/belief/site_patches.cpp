#include "belief/site_patches.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace palpation {
namespace {

constexpr int kPatches = 8, kPatchSites = 80;

}  // namespace

std::vector<int> nearest_to(const Points& sites, const Vec3& place, int count) {
  std::vector<std::pair<double, int>> order;
  for (Eigen::Index i = 0; i < sites.rows(); ++i)
    order.emplace_back((sites.row(i).transpose() - place).squaredNorm(), static_cast<int>(i));
  count = std::min(count, static_cast<int>(order.size()));
  std::partial_sort(order.begin(), order.begin() + count, order.end());
  std::vector<int> nearest;
  for (int i = 0; i < count; ++i) nearest.push_back(order[static_cast<std::size_t>(i)].second);
  return nearest;
}

std::vector<int> patches_of(const Points& sites) {
  if (sites.rows() <= kPatches * kPatchSites) {
    std::vector<int> all(static_cast<std::size_t>(sites.rows()));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
    return all;
  }
  std::vector<bool> taken(static_cast<std::size_t>(sites.rows()), false);
  Field far = Field::Constant(sites.rows(), std::numeric_limits<double>::infinity());
  Eigen::Index centre = 0;
  for (int patch = 0; patch < kPatches; ++patch) {
    const Vec3 place = sites.row(centre);
    for (const int i : nearest_to(sites, place, kPatchSites))
      taken[static_cast<std::size_t>(i)] = true;
    far = far.cwiseMin((sites.rowwise() - place.transpose()).rowwise().squaredNorm());
    far.maxCoeff(&centre);
  }
  std::vector<int> chosen;
  for (std::size_t i = 0; i < taken.size(); ++i) {
    if (taken[i]) chosen.push_back(static_cast<int>(i));
  }
  return chosen;
}

}  // namespace palpation
