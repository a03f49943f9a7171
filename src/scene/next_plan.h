/// From measurements to the next plan: what `palpate plan` and a session share.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "palpation/exploration/waypoint.h"
#include "palpation/io/csv.h"
#include "palpation/io/measurements.h"
#include "scene/episode.h"

namespace palpation::tool {

struct NextPlan {
  Episode episode;                ///< what the measurements say
  std::vector<int> stops{};       ///< vertices, in the order of travel; empty: finished
  std::vector<Waypoint> poses{};  ///< of the stops
  std::vector<Waypoint> way{};    ///< of the places between them
  std::vector<int> legs{};        ///< which stop each of these leads to
  double length_m = 0.0;          ///< of the way
};

/// Throws IoError for a scene that has no next plan: a scan.
void check_plans(const Scene& scene);

/// Measurements as the scene reads them. Throws IoError, as measurements_of does, and for more
/// places than can be modelled.
MeasurementsFile measured_on(const Scene& scene, const Surface& surface, const CsvTable& table);

/// First the scene's plan.touch_first_mm, then what its plan chooses.
NextPlan next_plan(const Scene& scene, const Surface& surface,
                   std::span<const Palpation> palpations);

}  // namespace palpation::tool
