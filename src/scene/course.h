/// Where a probe went in a run: the stops of all batches, and the way between them.
#pragma once

#include <span>
#include <vector>

#include "palpation/exploration/exploration.h"

namespace palpation::tool {

struct Course {
  std::vector<int> stops{};         ///< in the order of travel
  std::vector<SurfacePoint> way{};  ///< the places between them
  std::vector<int> legs{};  ///< the stop that each of these leads to, by its place among the stops
  double length_m = 0.0;

  /// A batch more: the tour led to these stops.
  void add(std::span<const int> more_stops, const Tour& tour) {
    const int before = static_cast<int>(stops.size());
    stops.insert(stops.end(), more_stops.begin(), more_stops.end());
    way.insert(way.end(), tour.way.begin(), tour.way.end());
    for (const int leg : tour.legs) legs.push_back(before + leg);
    length_m += tour.length_m;
  }
};

}  // namespace palpation::tool
