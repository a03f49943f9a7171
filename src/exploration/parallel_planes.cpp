#include "exploration/parallel_planes.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace palpation {
namespace {

constexpr Eigen::Index kFewest = 10;
constexpr std::size_t kMost = 400;  ///< of which all are used: a slope needs no more
constexpr int kRounds = 30;
/// What rises over the tissue, of how the readings differ: with a tumour it is no more than all.
constexpr std::array kRises = {-1.0, -0.5, 0.0, 0.5, 1.0};
/// Of the values: on neither plane, but on the way from one to the other, or wrong.
constexpr double kElsewhere = 0.1;
/// Noise below this part of the range is no noise: the likelihood would grow without bound.
constexpr double kLeastSd = 1e-3;
/// Two that differ by less are one, of the range over the tissue.
constexpr double kSame = 0.05;

/// Low, how much higher the high one is, and the slope: in units in which places and values reach
/// from 0 to 1.
using Planes = Eigen::Vector4d;

struct Fit {
  Planes planes = Planes::Zero();
  double high_share = 0.3;
  double variance = 0.0;
  double log_likelihood = 0.0;
};

/// Values in [0, 1] at places in [0, 1]^2.
struct Data {
  Eigen::MatrixX2d places;
  Eigen::VectorXd values;
};

/// The two groups that the values less the slope are cut into by the split with the least squares.
Fit first_fit(const Data& data, const Eigen::Vector2d& slope) {
  Eigen::VectorXd left = data.values - data.places * slope;
  std::sort(left.begin(), left.end());
  const Eigen::Index count = left.size();
  const double all = left.sum();
  double sum = 0.0, best = -1.0;
  Fit fit;
  for (Eigen::Index below = 1; below < count; ++below) {
    sum += left[below - 1];
    const double low = sum / static_cast<double>(below),
                 high = (all - sum) / static_cast<double>(count - below);
    const double between =
        static_cast<double>(below) * static_cast<double>(count - below) * std::pow(high - low, 2);
    if (between <= best) continue;
    best = between;
    fit.planes << low, high - low, slope;
    fit.high_share = static_cast<double>(count - below) / static_cast<double>(count);
  }
  const double squares = (left.array() - all / static_cast<double>(count)).square().sum() -
                         best / static_cast<double>(count);
  fit.variance = std::max(squares / static_cast<double>(count), kLeastSd * kLeastSd);
  return fit;
}

/// One round, without a slope where they are level; the likelihood is that before it.
void improve(const Data& data, bool are_level, Fit& fit) {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  double on_high = 0.0, on_planes = 0.0, values_squared = 0.0;
  fit.log_likelihood = 0.0;
  const double height = (1.0 - kElsewhere) / std::sqrt(2.0 * std::numbers::pi * fit.variance);
  for (Eigen::Index i = 0; i < data.values.size(); ++i) {
    Planes low, high;
    low << 1.0, 0.0, data.places.row(i).transpose();
    high << 1.0, 1.0, data.places.row(i).transpose();
    const double value = data.values[i];
    const auto density = [&](const Planes& plane, double share) {
      return share * height *
             std::exp(-0.5 * std::pow(value - plane.dot(fit.planes), 2) / fit.variance);
    };
    const double as_low = density(low, 1.0 - fit.high_share),
                 as_high = density(high, fit.high_share), sum = as_low + as_high + kElsewhere;
    fit.log_likelihood += std::log(sum);
    for (const auto& [plane, weight] : {std::pair(low, as_low / sum), {high, as_high / sum}}) {
      normal += weight * plane * plane.transpose();
      right += weight * value * plane;
      values_squared += weight * value * value;
      on_planes += weight;
    }
    on_high += as_high / sum;
  }
  if (!(on_planes > 0.0)) return;
  normal.diagonal().array() += 1e-9 * on_planes;
  if (are_level) {
    normal.topRightCorner<2, 2>().setZero();
    normal.bottomLeftCorner<2, 2>().setZero();
    right.tail<2>().setZero();
  }
  fit.planes = normal.ldlt().solve(right);
  const double squares =
      values_squared - 2.0 * right.dot(fit.planes) + fit.planes.dot(normal * fit.planes);
  fit.variance = std::max(squares / on_planes, kLeastSd * kLeastSd);
  const double least = 1.0 / static_cast<double>(data.values.size());
  fit.high_share = std::clamp(on_high / on_planes, least, 1.0 - least);
}

Fit fitted(const Data& data, const Eigen::Vector2d& first_slope, bool are_level) {
  Fit fit = first_fit(data, first_slope);
  for (int round = 0; round < kRounds; ++round) improve(data, are_level, fit);
  return fit;
}

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
  const double level = fitted(data, Eigen::Vector2d::Zero(), true).log_likelihood;
  std::vector<Fit> fits;
  for (const double along : kRises) {
    for (const double across : kRises) {
      const Fit fit = fitted(data, {along, across}, false);
      if (fit.log_likelihood > level + needed) fits.push_back(fit);
    }
  }
  std::ranges::stable_sort(fits, std::greater{}, &Fit::log_likelihood);
  std::vector<Eigen::Vector2d> slopes;
  for (const Fit& fit : fits) {
    const Eigen::Vector2d slope = fit.planes.tail<2>();
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
