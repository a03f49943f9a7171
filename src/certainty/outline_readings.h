/// What outlines are drawn from.
#pragma once

#include <vector>

#include "certainty/outline_background.h"
#include "palpation/geometry/surface_point.h"
#include "palpation/readings/palpation.h"

namespace palpation {

/// How far readings lie elsewhere for one unit of each term of their ways (wandering.h), over the
/// scale of such ways.
struct ReadingWays {
  Eigen::VectorXd own{};      ///< of each reading by its own way: of means of several less
  Eigen::MatrixXd lasting{};  ///< by ways that last: rows are readings, columns terms
};

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
  ReadingWays ways{};                     ///< none where places are known
};

}  // namespace palpation
