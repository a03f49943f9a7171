#include "certainty/wandering.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "certainty/drawn_core.h"
#include "certainty/errors_in_turn.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

constexpr double kLasting = 10.0;         ///< readings: over a breath
constexpr double kLeastScale_m = 0.0002;  ///< on each axis: half of the prior lies below
constexpr double kMedian_m = 0.0001;      ///< of either kind of way, beforehand
constexpr Eigen::Index kMostTerms = 400;
constexpr double kNothing = 1e-3;                            ///< of a way
constexpr int kWalks = 2, kUnwatched = 300, kWatched = 200;  ///< sweeps

/// Of both kinds of ways together, metres on each axis.
double scale_of(const Wandering& wandering) {
  return std::hypot(std::exp(wandering.of_each.log_scale), std::exp(wandering.lasting.log_scale));
}

/// In any sweep of a walk that has settled.
double least_scale(const OutlineStart& start, std::uint64_t seed) {
  OutlineWalk walk(start.readings, start.prior, start.outline, start.profile, seed);
  walk.settle(kUnwatched, kUnwatched / 2);
  double least = scale_of(walk.chain().profile().wandering);
  for (int i = 0; i < kWatched; ++i) {
    walk.settle(1);
    least = std::min(least, scale_of(walk.chain().profile().wandering));
  }
  return least;
}

}  // namespace

ReadingWays ways_of(std::span<const std::vector<Made>> made) {
  ReadingWays ways{.own = Eigen::VectorXd(std::ssize(made))};
  double all = 0.0;
  for (Eigen::Index row = 0; row < ways.own.size(); ++row) {
    const auto count = static_cast<double>(made[static_cast<std::size_t>(row)].size());
    ways.own[row] = 1.0 / std::sqrt(count);
    all += count;
  }
  const double lasting = kLasting * std::max(1.0, all / static_cast<double>(kMostTerms));
  const Eigen::MatrixXd terms = terms_of_errors(made, lasting, kMostTerms);
  ways.lasting = (terms.array().abs() < kNothing).select(0.0, terms);
  return ways;
}

void let_wander(const ReadingWays& ways, OutlineStart& start) {
  start.readings.ways = ways;
  const auto no_ways = [](Eigen::Index count) {
    return Wandering::Ways{Eigen::MatrixX2d::Zero(count, 2), std::log(kMedian_m)};
  };
  start.profile.wandering = {no_ways(ways.own.size()), no_ways(ways.lasting.cols())};
  start.prior.median.wandering = start.profile.wandering;
}

/// Walks that see the prior alone fall below the least, too.
bool do_places_wander(const OutlineStart& wandering, std::uint64_t seed) {
  if (wandering.profile.wandering.is_none()) return false;
  std::array<double, kWalks> least{};
  for_ranges(kWalks, 1, [&](int first, int last) {
    for (int walk = first; walk < last; ++walk)
      least[walk] = least_scale(wandering, kWalks * ~seed + static_cast<std::uint64_t>(walk));
  });
  return std::ranges::max(least) > kLeastScale_m;
}

WanderingPlaces wandering_by(const std::vector<OutlineDraw>& draws,
                             const OutlineReadings& readings) {
  const Eigen::Index count = std::ssize(readings.places);
  Eigen::MatrixX2d mean = Eigen::MatrixX2d::Zero(count, 2);
  std::vector<double> sizes, lasting;
  for (const OutlineDraw& draw : draws) {
    const Wandering& wandering = draw.profile.wandering;
    Eigen::MatrixX2d ways(count, 2);
    for (Eigen::Index i = 0; i < count; ++i)
      ways.row(i) = way_of(wandering, readings, i).transpose();
    sizes.push_back(std::sqrt(ways.rowwise().squaredNorm().mean()));
    lasting.push_back(std::exp(2.0 * wandering.lasting.log_scale) /
                      std::pow(scale_of(wandering), 2));
    mean += ways / static_cast<double>(draws.size());
  }
  // Of a row of several readings nobody knows which.
  Eigen::VectorXd squares = mean.rowwise().squaredNorm();
  for (Eigen::Index i = 0; i < count; ++i) {
    if (readings.made[static_cast<std::size_t>(i)].size() > 1) squares[i] = 0.0;
  }
  Eigen::Index row = 0;
  const double square = squares.maxCoeff(&row);
  return {.way_m = summed_up(std::move(sizes)),
          .lasting = summed_up(std::move(lasting)),
          .farthest = readings.made[static_cast<std::size_t>(row)].front().number,
          .farthest_m = std::sqrt(square)};
}

}  // namespace palpation
