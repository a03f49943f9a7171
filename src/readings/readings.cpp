#include "readings/readings.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>

namespace palpation {
namespace {

constexpr Eigen::Index kEnoughForPlane = 15;

}  // namespace

std::vector<double> used_readings(std::span<const Palpation> palpations) {
  std::vector<double> readings;
  for (const Palpation& palpation : palpations) {
    if (counts(palpation)) readings.push_back(palpation.reading);
  }
  return readings;
}

Made made_of(std::span<const Palpation> palpations, std::size_t place) {
  const Palpation& one = palpations[place];
  return {one.batch, one.number.value_or(place), one.session, one.bound, one.travel};
}

std::vector<std::size_t> in_time(std::span<const Palpation> palpations, std::size_t most) {
  std::vector<std::size_t> used, some;
  for (std::size_t i = 0; i < palpations.size(); ++i) {
    if (counts(palpations[i])) used.push_back(i);
  }
  std::ranges::stable_sort(used, {}, [&](std::size_t i) {
    return std::pair(palpations[i].batch, made_of(palpations, i).number);
  });
  const std::size_t stride = (used.size() + most - 1) / most;
  for (std::size_t i = 0; i < used.size(); i += stride) some.push_back(used[i]);
  return some;
}

PlacedReadings placed_readings(const Surface& surface, std::span<const Palpation> palpations) {
  const std::vector<double> readings = used_readings(palpations);
  PlacedReadings placed{Eigen::MatrixX3d(readings.size(), 3),
                        Eigen::Map<const Eigen::VectorXd>(
                            readings.data(), static_cast<Eigen::Index>(readings.size()))};
  Eigen::Index row = 0;
  for (const Palpation& palpation : palpations) {
    if (counts(palpation)) placed.places.row(row++) = surface.position(palpation.where);
  }
  return placed;
}

bool all_equal(std::span<const double> readings) {
  return std::ranges::adjacent_find(readings, std::not_equal_to<>()) == readings.end();
}

Spread spread_of(std::span<const double> readings) {
  const auto count = static_cast<double>(readings.size());
  Spread spread;
  for (const double reading : readings) spread.mean += (reading - readings.front()) / count;
  spread.mean += readings.front();
  double square = 0.0;
  for (const double reading : readings)
    square += (reading - spread.mean) * (reading - spread.mean) / count;
  spread.sd = all_equal(readings) ? 0.0 : std::sqrt(square);
  return spread;
}

double explained_by_plane(const Surface& surface, std::span<const Palpation> palpations) {
  auto [places, readings] = placed_readings(surface, palpations);
  if (readings.size() < kEnoughForPlane) return 0.0;
  places.rowwise() -= places.colwise().mean().eval();
  readings.array() -= readings.mean();
  const double square = readings.squaredNorm();
  if (!(square > 0.0)) return 0.0;
  const Eigen::VectorXd plane = places * places.completeOrthogonalDecomposition().solve(readings);
  return plane.squaredNorm() / square;
}

}  // namespace palpation
