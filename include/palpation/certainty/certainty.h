/// How sure the boundary is: everywhere at once, in one field.
///
/// At each vertex the score says how many standard deviations the place lies inside the boundary
/// (outside where negative), the level's own uncertainty included:  P(inside) = Phi(score). Level
/// sets of the score are the boundary's margins: 0 is the boundary, q and -q bound a band,
/// -Phi^-1(1 - r) is the line beyond which tissue is tumour with probability r at most.
#pragma once

#include "palpation/belief/belief.h"
#include "palpation/belief/level.h"
#include "palpation/certainty/edge_belief.h"
#include "palpation/certainty/expected_error.h"
#include "palpation/certainty/outline_posterior.h"

namespace palpation {

struct Certainty {
  Field score;                ///< at the vertices
  double probability = 0.95;  ///< with this probability the whole true outline lies in the band ...
  double band_score = 0.0;    ///< ... where |score| <= band_score: the inner loop is { score =
                              ///< band_score }, the outer { score = -band_score }
  double half_width_m =
      0.0;  ///< of the band along the surface, the mean over the boundary; 0 where there is none
  ExpectedError expected;     ///< wrong area of the region { score >= 0 }, by its boundary
  double untouched_m2 = 0.0;  ///< area too far from any reading for the boundary's depth to tell
  double untouched_error_m2 = 0.0;  ///< of that, what the field expects to be wrong, besides

  /// Wrong area of the region, wherever it is: what a stop rule promises.
  double expected_in_all_m2() const {
    return expected.symmetric_difference_m2() + untouched_error_m2;
  }
  /// Phi(score).
  Field probability_inside() const;
  /// The score of the cut line: outside { score >= cut_score(r) } a place is tumour with
  /// probability r at most. Throws InvalidInput unless 0 < r < 1.
  static double cut_score(double risk);
};

/// Throws InvalidInput unless 0 < probability < 1. `marginals`: of a belief, at the vertices.
Certainty certainty_of(const Surface& surface, const Marginals& marginals, const Level& level,
                       double probability = 0.95);

/// The same of a boundary that is believed in depths: the score is the depth over the standard
/// deviation of the boundary's offset.
Certainty certainty_of(const Surface& surface, const EdgeBelief& edge, double probability = 0.95);

/// The same of outlines that were drawn: the score is the median depth over the draws' spread, and
/// the band is as wide as their outlines, each as a whole, ask for.
Certainty certainty_of(const Surface& surface, const OutlinePosterior& outlines,
                       double probability = 0.95);

}  // namespace palpation
