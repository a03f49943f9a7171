#include "readings/dense_stops.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "readings/as_one.h"
#include "readings/readings.h"

namespace palpation {
namespace {

/// Of one session, batch and end of the sensor's range, and a cube.
using Cell = std::tuple<int, int, Bound, long, long, long>;

Cell cell_of(const Palpation& palpation, const Vec3& place, double within_m) {
  const Vec3 cube = place / within_m;
  return {palpation.session,
          palpation.batch,
          palpation.bound,
          std::lround(std::floor(cube.x())),
          std::lround(std::floor(cube.y())),
          std::lround(std::floor(cube.z()))};
}

}  // namespace

std::vector<Palpation> merged_in_cells(const Surface& surface,
                                       std::span<const Palpation> palpations, double within_m,
                                       double noise_variance) {
  std::vector<std::pair<std::size_t, Palpation>> merged;  // by when the first of each was made
  std::map<Cell, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < palpations.size(); ++i) {
    const Palpation& palpation = palpations[i];
    if (palpation.kind == TouchKind::Stop && palpation.set_aside.empty() &&
        variance_of(palpation, noise_variance) > 0.0) {
      cells[cell_of(palpation, surface.position(palpation.where), within_m)].push_back(i);
    } else {
      merged.emplace_back(i, palpation);
    }
  }
  for (auto& [cell, felt] : cells) {
    std::ranges::sort(felt, {}, [&](std::size_t i) {
      const Vec3 place = surface.position(palpations[i].where);
      return std::tuple(palpations[i].reading, place.x(), place.y(), place.z());
    });
    for (auto first = felt.begin(), end = first; first != felt.end(); first = end) {
      end = std::find_if_not(first, felt.end(), [&](std::size_t i) {
        return are_alike(palpations[*first], palpations[i], noise_variance);
      });
      if (end - first == 1) {
        merged.emplace_back(*first, palpations[*first]);
        continue;
      }
      std::vector<Palpation> together;
      for (auto i = first; i != end; ++i) together.push_back(palpations[*i]);
      AsOne one = as_one(surface, together, noise_variance);
      one.palpation.where = surface.project(surface.position(together.front().where) + one.shift_m);
      merged.emplace_back(*std::min_element(first, end), std::move(one.palpation));
    }
  }
  std::ranges::sort(merged, {}, [](const auto& one) { return one.first; });
  std::vector<Palpation> result;
  for (auto& [place, palpation] : merged) {
    palpation.number = made_of(palpations, place).number;
    result.push_back(std::move(palpation));
  }
  return result;
}

}  // namespace palpation
