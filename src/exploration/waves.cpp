#include "exploration/waves.h"

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
/// Two that differ by less are one, of the range: root mean square.
constexpr double kSame = 0.05;

/// The rows in an order that is the same however they come.
std::vector<std::size_t> by_place(const Layout& layout, const EdgeData& readings) {
  std::vector<std::size_t> order(readings.places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) {
    const Vec3 at = layout.at(readings.places[i]);
    return std::array{at.x(), at.y(), at.z(), readings.reading[static_cast<Eigen::Index>(i)]};
  });
  return order;
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
  const auto [rows, values, range] = some_of(readings.reading, by_place(layout, readings), kMost);
  if (!(range > 0.0)) return {};
  std::vector<SurfacePoint> places;
  for (const std::size_t row : rows) places.push_back(readings.places[row]);
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
    for (ParallelSurfaces& surfaces : all_parallel_surfaces(background, values)) {
      if (!(surfaces.log_evidence > level + needed)) continue;
      Candidate one{waves.size() - 1, std::move(surfaces), {}};
      one.shared = terms * one.surfaces.coefficients;
      one.shared.array() -= one.shared.mean();
      candidates.push_back(std::move(one));
    }
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
