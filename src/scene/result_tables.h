/// The tables that a run writes: trace.csv, waypoints.csv, path.csv.
#pragma once

#include <string>
#include <vector>

#include "palpation/exploration/trace.h"
#include "palpation/exploration/waypoint.h"

namespace palpation::tool {

std::string trace_csv(const Trace& trace, double search_area_m2);

/// `legs`: for places on the way, which stop each leads to.
std::string waypoint_csv(const std::vector<Waypoint>& waypoints,
                         const std::vector<int>* legs = nullptr);

}  // namespace palpation::tool
