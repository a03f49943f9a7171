/// What outlines are drawn from.
#pragma once

#include <vector>

#include "certainty/outline_background.h"
#include "palpation/geometry/surface_point.h"
#include "palpation/readings/palpation.h"

namespace palpation {

/// The readings, one per place, in the chart's plane.
struct OutlineReadings {
  std::vector<Vec2> places;
  std::vector<double> reading;
  std::vector<double> variance;  ///< of the noise
  /// In which of OutlinePrior::epochs each was made; empty where there is but the first.
  std::vector<int> epoch{};
  BackgroundTerms background{};
  Eigen::VectorXd shares{};     ///< of the contrast, by the first outline: noise grows with them
  std::vector<Bound> bounds{};  ///< where the sensor's range ended; empty where it did nowhere
  /// In which direction the probe came to each, at most of length one; empty where all are known
  /// to be of where they were made.
  std::vector<Vec2> travel{};
  std::vector<SurfacePoint> where{};      ///< on the surface, where those are of one; else none
  std::vector<std::vector<Made>> made{};  ///< each of which there may be several; else none
  /// How far each lies elsewhere for one unit of its own way, over the scale of such ways: means of
  /// several less. Empty where places are known.
  Eigen::VectorXd own_ways{};
  /// The same for one unit of each term of a way that lasts (wandering.h), over
  /// that way's scale: rows are readings, columns terms. Empty where places are known.
  Eigen::MatrixXd lasting_ways{};
};

}  // namespace palpation
