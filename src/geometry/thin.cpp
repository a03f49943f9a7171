#include "palpation/geometry/thin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <tuple>
#include <unordered_map>

#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kStep = 1.1;  // between one radius that is tried and the next

std::vector<int> by_place(const Points& points) {
  std::vector<int> order(static_cast<std::size_t>(points.rows()));
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int i) { return std::tuple(points(i, 0), points(i, 1), points(i, 2), i); };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  return order;
}

/// Centres by the cell of the grid that they lie in: cells are as wide as the radius, so that what
/// is within it lies in the 27 around.
class Cover {
 public:
  explicit Cover(double radius) : radius_(radius) {}

  /// The centre that a point belongs to, perhaps itself.
  int take(const Vec3& point) {
    const std::array<std::int64_t, 3> cell = cell_of(point);
    int nearest = -1;
    double least = radius_ * radius_;
    for (std::int64_t k = 0; k < 27; ++k) {
      const auto found =
          cells_.find(key({cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1}));
      if (found == cells_.end()) continue;
      for (const int centre : found->second) {
        const double square = (centres_[static_cast<std::size_t>(centre)] - point).squaredNorm();
        if (square < least || (square == least && nearest < 0)) {
          least = square;
          nearest = centre;
        }
      }
    }
    if (nearest >= 0) return nearest;
    const int fresh = size();
    centres_.push_back(point);
    cells_[key(cell)].push_back(fresh);
    return fresh;
  }

  int size() const { return static_cast<int>(centres_.size()); }

 private:
  std::array<std::int64_t, 3> cell_of(const Vec3& point) const {
    std::array<std::int64_t, 3> cell;
    for (int axis = 0; axis < 3; ++axis)
      cell[static_cast<std::size_t>(axis)] =
          static_cast<std::int64_t>(std::floor(point[axis] / radius_));
    return cell;
  }

  /// Cells that share a key are only looked at in vain.
  static std::uint64_t key(const std::array<std::int64_t, 3>& cell) {
    std::uint64_t mixed = 0;
    for (const std::int64_t index : cell)
      mixed = (mixed ^ static_cast<std::uint64_t>(index)) * 0x9E3779B97F4A7C15u;
    return mixed;
  }

  double radius_;
  std::vector<Vec3> centres_;
  std::unordered_map<std::uint64_t, std::vector<int>> cells_;
};

/// Nothing where there would be more than `most` groups.
std::optional<std::vector<int>> groups(const Points& points, const std::vector<int>& order,
                                       double radius, int most) {
  Cover cover(radius);
  std::vector<int> group(order.size());
  for (const int i : order) {
    group[static_cast<std::size_t>(i)] = cover.take(points.row(i));
    if (cover.size() > most) return std::nullopt;
  }
  return group;
}

std::vector<int> equal_points(const Points& points, const std::vector<int>& order) {
  std::vector<int> group(order.size());
  int count = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && points.row(order[i]) != points.row(order[i - 1])) ++count;
    group[static_cast<std::size_t>(order[i])] = count;
  }
  return group;
}

Thinned means(const Points& points, std::vector<int> group, double radius_m) {
  const int count = group.empty() ? 0 : *std::max_element(group.begin(), group.end()) + 1;
  Thinned result{Points::Zero(count, 3), std::move(group), radius_m};
  Eigen::VectorXd size = Eigen::VectorXd::Zero(count);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const int of = result.group[static_cast<std::size_t>(i)];
    size[of] += 1.0;
    // A running mean: equal points stay the point they are.
    result.points.row(of) += (points.row(i) - result.points.row(of)) / size[of];
  }
  return result;
}

}  // namespace

Thinned thin(const Points& points, int most) {
  require(points.allFinite(), "thin", "points", "must be finite");
  require(most >= 1, "thin", "most = " + std::to_string(most), "must be at least 1");
  if (points.rows() == 0) return {};
  const std::vector<int> order = by_place(points);
  std::vector<int> group = equal_points(points, order);
  if (*std::max_element(group.begin(), group.end()) < most)
    return means(points, std::move(group), 0.0);

  const Vec3 low = points.colwise().minCoeff();
  const Points local = points.rowwise() - low.transpose();
  double radius = local.colwise().maxCoeff().norm() / (4.0 * std::sqrt(most));
  std::optional<std::vector<int>> found = groups(local, order, radius, most);
  while (found) {  // is it more than it need be?
    std::optional<std::vector<int>> finer = groups(local, order, radius / kStep, most);
    if (!finer) return means(points, *std::move(found), radius);
    found = std::move(finer);
    radius /= kStep;
  }
  while (!found) found = groups(local, order, radius *= kStep, most);
  return means(points, *std::move(found), radius);
}

}  // namespace palpation
