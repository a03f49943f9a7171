#include "exploration/waves.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include "certainty/slow_waves.h"
#include "exploration/parallel_surfaces.h"

namespace palpation {
namespace {

constexpr std::size_t kFewest = 15;
constexpr std::size_t kMost = 200;  ///< of which all are used: a slow wave needs no more
/// Of readings that shall lie below the first background, each weighed by how far it lies off.
constexpr std::array kBelow = {0.05, 0.2, 0.5, 0.8, 0.95};
constexpr double kFirstNoise = 0.1;  ///< of the range: a tumour's contrast is none of the waves'
constexpr int kWeighings = 10;
/// Two that differ by less are one, of the range: root mean square.
constexpr double kSame = 0.05;

/// Every so many of them, whatever order they come in, from 0 to 1.
struct Scaled {
  std::vector<SurfacePoint> places;
  Eigen::VectorXd values;
  double range = 0.0;
};

Scaled scaled(const Layout& layout, const EdgeData& readings) {
  std::vector<std::size_t> order(readings.places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) {
    const Vec3 at = layout.at(readings.places[i]);
    return std::array{at.x(), at.y(), at.z(), readings.reading[static_cast<Eigen::Index>(i)]};
  });
  const std::size_t step = (order.size() + kMost - 1) / kMost;
  Scaled made;
  std::vector<Eigen::Index> some;
  for (std::size_t i = 0; i < order.size(); i += step) {
    made.places.push_back(readings.places[order[i]]);
    some.push_back(static_cast<Eigen::Index>(order[i]));
  }
  made.values = readings.reading(some);
  const double least = made.values.minCoeff();
  made.range = made.values.maxCoeff() - least;
  if (made.range > 0.0) made.values = (made.values.array() - least) / made.range;
  return made;
}

/// The background that values lie off, those above it `below` times as much as those below
/// 1 - below (Newey and Powell 1987).
Eigen::VectorXd expectile(const SharedBackground& background, const Eigen::VectorXd& values,
                          double below) {
  const Eigen::Index terms = background.terms.cols();
  Eigen::MatrixXd rows(values.size(), 1 + terms);
  rows << Eigen::VectorXd::Ones(values.size()), background.terms;
  Eigen::VectorXd weight = Eigen::VectorXd::Constant(values.size(), 0.5), found;
  for (int round = 0; round < kWeighings; ++round) {
    Eigen::MatrixXd normal = rows.transpose() * weight.asDiagonal() * rows;
    normal.diagonal().tail(terms) += kFirstNoise * kFirstNoise * background.precision;
    found = normal.ldlt().solve(rows.transpose() * weight.cwiseProduct(values));
    const Eigen::VectorXd level = rows * found;
    weight = (values.array() > level.array())
                 .select(Eigen::VectorXd::Constant(values.size(), below), 1.0 - below);
  }
  return background.terms * found.tail(terms);
}

/// Of one length.
struct Candidate {
  std::size_t length = 0;
  ParallelSurfaces surfaces;
  Eigen::VectorXd shared;  ///< at the values, without its mean
};

}  // namespace

std::vector<Field> waves_of_parallel_surfaces(const Layout& layout, const EdgeData& readings,
                                              double needed, int most) {
  if (readings.places.size() < kFewest) return {};
  const auto [places, values, range] = scaled(layout, readings);
  if (!(range > 0.0)) return {};
  const Eigen::Index count = values.size();
  const Eigen::VectorXd level_ones = Eigen::VectorXd::Zero(count);
  const double level =
      parallel_surfaces({Eigen::MatrixXd(count, 0), Eigen::VectorXd(0)}, values, level_ones)
          .log_likelihood;
  std::vector<SlowWaves> waves;
  std::vector<Candidate> candidates;
  for (const double length_m : kSlowLengths_m) {
    waves.emplace_back(layout.surface(), layout.metric(), length_m, places);
    const Eigen::MatrixXd& terms = waves.back().terms();
    const SharedBackground background{terms, Eigen::VectorXd::Ones(terms.cols())};
    const auto add_from = [&](const Eigen::VectorXd& first) {
      Candidate one{waves.size() - 1, parallel_surfaces(background, values, first), {}};
      if (!(one.surfaces.log_evidence > level + needed)) return;
      one.shared = terms * one.surfaces.coefficients;
      one.shared.array() -= one.shared.mean();
      candidates.push_back(std::move(one));
    };
    add_from(level_ones);
    for (const double below : kBelow) add_from(expectile(background, values, below));
  }
  std::ranges::stable_sort(candidates, std::greater{},
                           [](const Candidate& one) { return one.surfaces.log_evidence; });
  std::vector<const Candidate*> told;
  for (const Candidate& one : candidates) {
    const auto is_known = [&](const Candidate* other) {
      return (other->shared - one.shared).norm() < kSame * std::sqrt(static_cast<double>(count));
    };
    if (std::ssize(told) < most && std::ranges::none_of(told, is_known)) told.push_back(&one);
  }
  std::vector<Field> backgrounds;
  for (const Candidate* one : told)
    backgrounds.push_back(waves[one->length].at_vertices(range * one->surfaces.coefficients));
  return backgrounds;
}

}  // namespace palpation
