/// Which vertices to touch next, chosen together before any of them is touched.
///
/// Greedy: each pick has the best score given the variance that the earlier picks will remove
/// (variance depends on places, not on readings; the mean stays as it is: Garg et al. 2016 after
/// Gotovos et al. 2013). Ties go to the lowest vertex.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "palpation/decision/acquisition.h"

namespace palpation {

enum class Evaluation {
  Automatic,  ///< lazy where the acquisition allows it
  Lazy,  ///< old scores are upper bounds, since stddev only falls: evaluate only what could be best
  Exhaustive  ///< every candidate for every pick: the twin
};

struct BatchOptions {
  int size = 10;
  double least_spacing_m = 0.0;  ///< no two picks closer than this along the surface; 0: a vertex
                                 ///< may even be picked again, as the paper allows
  Evaluation evaluation = Evaluation::Automatic;
  double way_reading_m = 0.0;  ///< the probe also reads on its way, once per this length, and the
                               ///< picks count that; 0: it does not
  std::optional<SurfacePoint> from{};  ///< where the probe is
};

struct Batch {
  std::vector<int>
      vertices;  ///< in order of picking; fewer than asked for where candidates run out
  std::vector<double> scores;  ///< of each when it was picked
  long evaluations = 0;        ///< of the acquisition at a vertex
};

/// `candidates`: rising vertex indices. A touch's noise is the field's. Throws InvalidInput if size
/// is negative, the spacing negative or not finite, a candidate is no vertex or out of order, a
/// score is NaN, or Lazy is asked of an acquisition that does not promise to grow with stddev.
///
/// With readings on the way, a pick also removes the variance that those will: on the way to it
/// (path.h) from the nearest of the probe's place and the picks before. The tour is not known
/// before the batch is; this is what it comes to but for detours.
Batch choose_batch(const Belief& belief, const Acquisition& acquisition, const Level& level,
                   std::span<const int> candidates, const BatchOptions& options);

/// A reading that is only supposed: at a vertex, as precise as those that it stands for.
struct Supposed {
  int vertex = 0;
  double noise_variance = 0.0;
};

/// The readings on the way to a vertex from the nearest of `places`, in a straight line: one every
/// two millimetres, at a nearest vertex, ends left out. None where there is no place, or
/// `way_reading_m` is 0.
std::vector<Supposed> supposed_on_the_way(const Belief& belief, std::span<const Vec3> places,
                                          int vertex, double way_reading_m);

}  // namespace palpation
