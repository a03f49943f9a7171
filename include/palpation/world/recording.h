/// A dense recording as a world: a touch is answered by what a robot once felt there.
#pragma once

#include <optional>
#include <vector>

#include "palpation/base/types.h"
#include "palpation/geometry/scattered.h"
#include "palpation/geometry/surface.h"
#include "palpation/readings/palpation.h"

namespace palpation {

/// A recording's readings, in the order in which they were made.
struct RecordedReadings {
  Points positions;          ///< n x 3, metres, in the mesh's frame
  Eigen::VectorXd readings;  ///< n
};

/// Recordings of the same tissue, one for each direction of travel. Readings are projected to the
/// surface's chart and interpolated linearly over their Delaunay triangulation; farther than reach
/// (2 mm) from any reading there is no contact. On curved tissue, readings farther than that beside
/// the border are left out.
///
/// A recording's direction of travel is the mean of the unit steps between its readings, without
/// standstill and without jumps of more than 5 mm: close to a unit vector where its rows run one
/// way, close to zero where they run to and fro.
class RecordedWorld {
 public:
  /// Throws InvalidInput without recordings, where one is not finite or has fewer than three
  /// readings off one line, or unless the reach is positive and finite; and as Surface::chart.
  RecordedWorld(Surface surface, std::vector<RecordedReadings> recordings, double reach_m = 0.002);

  /// The reading at a place when the probe comes along `travel` (zero: unknown); nothing where
  /// there is no contact. Its own direction of travel is that in which it was recorded, where its
  /// recording's rows run one way, otherwise `travel`. With several recordings the one whose mean
  /// direction of travel fits best (by the scalar product) answers, the first of equals; where it
  /// has no contact there is none.
  std::optional<Palpation> touch(const SurfacePoint& where, const Vec3& travel) const;

  /// The first recording's interpolant at the vertices: the world's own map; `low` where there is
  /// no contact.
  Field map(double low) const;
  /// True for the vertices where every recording answers.
  std::vector<bool> in_contact() const;
  /// The q-quantile of the first recording's readings (linear between order statistics). Throws
  /// InvalidInput unless q is in [0, 1].
  double quantile(double q) const;

 private:
  Surface surface_;
  std::vector<ScatteredField> fields_;
  std::vector<Vec3> travels_;
  Eigen::VectorXd sorted_readings_;
  double reach_m_;
};

}  // namespace palpation
