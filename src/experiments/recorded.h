/// The physical recordings of Garg et al. 2016's probe, and what is looked at in them: R1 to R7,
/// each figure against its bound.
#pragma once

#include <string>
#include <vector>

#include "experiments/experiment.h"

namespace palpation::tool {

inline constexpr double kCm2 = 1e4;  ///< in a square metre

/// One figure against its bound.
struct Figure {
  std::string name, what;
  double value = 0.0, least = 0.0, most = 0.0;
  bool good() const { return value >= least && value <= most; }
};

/// A recording as it was made: places, readings, scan lines.
struct Recorded {
  std::string name;
  Surface tissue;
  std::vector<Palpation> palpations;
  std::vector<int> index, row;
  std::vector<Vec3> places;
};

/// Where a recording lies.
std::filesystem::path file_of(const ExperimentArguments& arguments, const std::string& name);

/// Reads one. Without heights: they are the arm's, not the tissue's. Rows that run one way along y
/// have that direction of travel.
Recorded recorded(const ExperimentArguments& arguments, const std::string& name);

/// What is used of the readings, thinned evenly: more lie closer together than any edge is sharp.
std::vector<Palpation> thinned(std::span<const Palpation> palpations);

/// Points of a boundary, apart from the tissue's border.
std::vector<Vec3> points_of(const Surface& surface, const Field& field, double level);

/// R4: what the screen sets aside.
void add_faults(const ExperimentArguments& arguments, std::vector<Figure>& figures);

/// R5: fading contact; R6: one recording's band against the boundary of another of the same rows.
void add_fading(const ExperimentArguments& arguments, const Scene& scene,
                std::vector<Figure>& figures);

}  // namespace palpation::tool
