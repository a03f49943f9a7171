/// The files that --out receives. Each is there whole or not at all.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "palpation/exploration/waypoint.h"
#include "scene/episode.h"

namespace palpation::tool {

class OutputFolder {
 public:
  /// Makes the folder if it is not there. Throws WriteError.
  OutputFolder(std::filesystem::path folder, const Scene& scene, const Surface& surface);

  void warn(const std::string& words) { warnings_.push_back(words); }

  /// steps/step_NNN.vtp for the state after a batch; steps.pvd lists them when the rest is written.
  void write_step(const Episode& episode, const World* world);

  /// trace.csv, measurements.csv, boundary.wkt, boundary.vtp, surface.vtp, steps.pvd, timings.json,
  /// and summary.json as the last: it is gone from the first write on, so that a folder without it
  /// is not finished.
  void write(const Episode& episode, const World* world, const nlohmann::json& timings);

  /// waypoints.csv and path.csv: the stops, and the places between them. Before write().
  void write_waypoints(const std::vector<Waypoint>& stops, const std::vector<Waypoint>& way,
                       const std::vector<int>& legs);

  /// summary.json of two boundaries that were compared.
  void write_comparison(const RegionError& error);

  /// picture.png and convergence.png, drawn by the program palpate-draw from the files above.
  /// Returns why not, or nothing.
  std::optional<std::string> draw() const;

  const std::filesystem::path& folder() const { return folder_; }

 private:
  void begin();
  void remove_what_an_earlier_run_left() const;
  nlohmann::json summary(const Episode& episode) const;
  void write_boundary(const Episode& episode, const World* world);

  std::filesystem::path folder_;
  const Scene& scene_;
  Surface surface_;
  std::vector<std::string> warnings_;
  std::vector<std::string> steps_;
  bool begun_ = false;
};

/// Makes a folder, and those above it, if it is not there. Throws WriteError.
void make_folder(const std::filesystem::path& folder);

/// Why the programs' picture could not be drawn, or nothing: runs palpate-draw, which lies beside
/// this program, with the given arguments.
std::optional<std::string> run_draw(const std::vector<std::string>& arguments);

}  // namespace palpation::tool
