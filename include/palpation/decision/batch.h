/// Which vertices to touch next, chosen together before any of them is touched.
///
/// Greedy: each pick has the best score given the variance that the earlier picks will remove (variance depends on places, not on readings;
/// the mean stays as it is: Garg et al. 2016 after Gotovos et al. 2013). Ties go to the lowest vertex.
#pragma once

#include <span>
#include <vector>

#include "palpation/decision/acquisition.h"

namespace palpation {

enum class Evaluation {
  Automatic,  ///< lazy where the acquisition allows it and enough is known for it to pay
  Lazy,       ///< old scores are upper bounds, since stddev only falls: evaluate only what could be best
  Exhaustive  ///< every candidate for every pick: the twin
};

struct BatchOptions {
  int size = 10;
  double least_spacing_m =
      0.0;  ///< no two picks closer than this in a straight line; 0: a vertex may even be picked again, as the paper allows
  Evaluation evaluation = Evaluation::Automatic;
};

struct Batch {
  std::vector<int> vertices;   ///< in order of picking; fewer than asked for where candidates run out
  std::vector<double> scores;  ///< of each when it was picked
  long evaluations = 0;        ///< of the acquisition at a vertex
};

/// `candidates`: rising vertex indices. A touch's noise is the field's. Throws InvalidInput if size is negative, the spacing negative or
/// not finite, a candidate is no vertex or out of order, a score is NaN, or Lazy is asked of an acquisition that does not promise to grow
/// with stddev.
Batch choose_batch(const Belief& belief, const Acquisition& acquisition, const Level& level, std::span<const int> candidates,
                   const BatchOptions& options);

}  // namespace palpation
