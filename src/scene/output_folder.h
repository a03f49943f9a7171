/// The files that --out receives: which, with what in them. How they land is run_folder.h's.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "palpation/exploration/waypoint.h"
#include "palpation/io/measurements.h"
#include "scene/episode.h"
#include "scene/run_folder.h"
#include "scene/tissue.h"

namespace palpation::tool {

/// Where to, by which command, and whether another run's results may be replaced there.
struct Destination {
  std::filesystem::path folder;
  std::string command;
  bool overwrite = false;
};

class OutputFolder {
 public:
  /// Once all is read that the command was given: the run's question is made of that. Throws as
  /// RunFolder does. Warnings are those of before the start.
  OutputFolder(const Destination& destination, const Scene& scene, const Tissue& tissue,
               std::vector<std::string> warnings = {});

  void warn(const std::string& words) { warnings_.push_back(words); }

  /// steps/step_NNN.vtp for the state after a batch; steps.pvd, which lists those so far, and
  /// measurements.csv.
  void write_step(const Episode& episode, const World* world);

  /// waypoints.csv and path.csv: the stops, and the places between them. Before write().
  void write_waypoints(const std::vector<Waypoint>& stops, const std::vector<Waypoint>& way,
                       const std::vector<int>& legs);

  /// trace.csv, measurements.csv, boundary.wkt, boundary.vtp, surface.vtp, steps.pvd, timings.json
  /// and summary.json. Without a world the readings were given: readings_used.csv in place of
  /// measurements.csv, with their foreign columns.
  void write(const Episode& episode, const World* world, const nlohmann::json& timings,
             const ForeignColumns& foreign = {});

  /// summary.json of two boundaries that were compared.
  void write_comparison(const RegionError& error);

  /// Draws picture.png and convergence.png, if that can be done, writes report.html but of a plan,
  /// and lands all that was written. Says where it is, and why there is no picture or report.
  void finish(bool quiet);

 private:
  void write_boundary(const Episode& episode, const World* world);
  void write_report(const std::filesystem::path& folder) const;

  nlohmann::json inputs_;
  std::vector<std::string> warnings_;
  RunFolder run_;
  const Scene& scene_;
  Surface surface_;
  Frame frame_;
  std::string command_;
  std::vector<std::string> steps_;
};

}  // namespace palpation::tool
