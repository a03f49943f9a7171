#include "exploration/parallel_planes.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

#include "exploration/parallel_surfaces.h"

namespace palpation {
namespace {

constexpr Eigen::Index kFewest = 10;
constexpr std::size_t kMost = 400;  ///< of which all are used: a slope needs no more
/// What rises over the tissue, of how the readings differ: with a tumour it is no more than all.
constexpr std::array kRises = {-1.0, -0.5, 0.0, 0.5, 1.0};
/// Two that differ by less are one, of the range over the tissue.
constexpr double kSame = 0.05;

/// Values in [0, 1] at places in [0, 1]^2.
struct Data {
  Eigen::MatrixX2d places;
  Eigen::VectorXd values;
};

/// Every so many of them, from 0 to 1 each, whatever order they come in.
struct Scaled {
  Data data;
  Eigen::Vector2d extent;
  double range = 0.0;
};

Scaled scaled(const Eigen::MatrixX2d& places, const Eigen::VectorXd& values) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size())), some;
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](Eigen::Index i) {
    return std::array{places(i, 0), places(i, 1), values[i]};
  });
  const std::size_t step = (order.size() + kMost - 1) / kMost;
  for (std::size_t i = 0; i < order.size(); i += step) some.push_back(order[i]);
  Scaled made{{places(some, Eigen::all), values(some)}, {}, {}};
  const Eigen::RowVector2d corner = places.colwise().minCoeff();
  made.extent = (places.colwise().maxCoeff() - corner).transpose();
  made.range = values.maxCoeff() - values.minCoeff();
  made.data.places.rowwise() -= corner;
  for (int axis = 0; axis < 2; ++axis) {
    if (made.extent[axis] > 0.0) made.data.places.col(axis) /= made.extent[axis];
  }
  if (made.range > 0.0)
    made.data.values = (made.data.values.array() - values.minCoeff()) / made.range;
  return made;
}

}  // namespace

std::vector<Eigen::Vector2d> slopes_of_parallel_planes(const Eigen::MatrixX2d& places,
                                                       const Eigen::VectorXd& values, double needed,
                                                       int most) {
  if (values.size() < kFewest) return {};
  const auto [data, extent, range] = scaled(places, values);
  if (!(range > 0.0) || !(extent.minCoeff() > 0.0)) return {};
  const auto fitted = [&](const Eigen::MatrixXd& terms, const Eigen::VectorXd& first) {
    return parallel_surfaces({terms, Eigen::VectorXd::Zero(terms.cols())}, data.values, first);
  };
  const Eigen::Index count = data.values.size();
  const double level =
      fitted(Eigen::MatrixXd(count, 0), Eigen::VectorXd::Zero(count)).log_likelihood;
  std::vector<ParallelSurfaces> fits;
  for (const double along : kRises) {
    for (const double across : kRises) {
      const ParallelSurfaces fit =
          fitted(data.places, data.places * Eigen::Vector2d(along, across));
      if (fit.log_likelihood > level + needed) fits.push_back(fit);
    }
  }
  std::ranges::stable_sort(fits, std::greater{}, &ParallelSurfaces::log_likelihood);
  std::vector<Eigen::Vector2d> slopes;
  for (const ParallelSurfaces& fit : fits) {
    const Eigen::Vector2d slope = fit.coefficients;
    const auto is_known = [&](const Eigen::Vector2d& other) {
      return (other - slope).norm() < kSame;
    };
    if (std::ssize(slopes) == most) break;
    if (std::ranges::none_of(slopes, is_known)) slopes.push_back(slope);
  }
  for (Eigen::Vector2d& slope : slopes) slope = range * slope.cwiseQuotient(extent);
  return slopes;
}

}  // namespace palpation
