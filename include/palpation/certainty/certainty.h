/// How sure the boundary is: everywhere at once, in one field.
///
/// At each vertex the score says how many standard deviations the place lies inside the boundary
/// (outside where negative), the level's own uncertainty included:  P(inside) = Phi(score). Level
/// sets of the score are the boundary's margins: 0 is the boundary, q and -q bound a band,
/// -Phi^-1(1 - r) is the line beyond which tissue is tumour with probability r at most.
#pragma once

#include <span>

#include "palpation/belief/belief.h"
#include "palpation/belief/level.h"
#include "palpation/certainty/edge_belief.h"
#include "palpation/certainty/expected_error.h"
#include "palpation/certainty/outline_posterior.h"

namespace palpation {

struct FadingContact;

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

/// Throws InvalidInput unless 0 < probability < 1. `marginals`: of the belief, at the vertices.
Certainty certainty_of(const Surface& surface, const Belief& belief, const Marginals& marginals,
                       const Level& level, double probability = 0.95);

/// The same of a boundary that is believed in depths: the score is the depth over the standard
/// deviation of the boundary's offset.
Certainty certainty_of(const Surface& surface, const EdgeBelief& edge, double probability = 0.95);

/// The same of outlines that were drawn: the score is the median depth over the draws' spread, and
/// the band is as wide as their outlines, each as a whole, ask for.
Certainty certainty_of(const Surface& surface, const OutlinePosterior& outlines,
                       double probability = 0.95);

/// What a probe with a round tip feels early, taken back (erosion.h): the score of the boundary
/// that lies a radius farther in, with the band's width along it. What is expected to be wrong
/// changes as the boundary's length does.
Certainty less_tip(Certainty certainty, const Surface& surface, double radius_m);

/// Where contact fades (contact.h) a tumour reads less than its plateau elsewhere, by up to what
/// healthy tissue's reading falls, in proportion to the way. `sd` is what the score was divided by,
/// at the vertices, and `whole_loss` by how much the boundary would be off, in the same unit, were
/// all amplitude lost. The doubt counts as one more standard deviation: band and expected error
/// grow with it.
Certainty doubted_where_contact_fades(Certainty certainty, const Surface& surface,
                                      const FadingContact& fading, const Field& sd,
                                      double whole_loss);

/// All readings may lie off along the surface, the same way, with this standard deviation, and the
/// whole boundary with them, as where a robot was registered so well: one more standard deviation
/// beside that of the boundary's offset, `offset_sd_m`, at the vertices.
Certainty doubted_as_a_whole(Certainty certainty, const Surface& surface, const Field& offset_sd_m,
                             double place_sd_m);

/// A part that counts as tumour no more: at these vertices the score is this one, which is
/// negative.
Certainty without_part(Certainty certainty, const Surface& surface, std::span<const int> vertices,
                       double score);

/// What stands out and may be tumour, or healthy tissue that is stiffer than the rest: which, no
/// reading tells. At these vertices, outside of the boundary, it is as likely as not; their own
/// boundary is known to `edge_sd_m`, and lies in the band, too. A half of them counts as missed.
Certainty with_doubtful_part(Certainty certainty, const Belief& belief,
                             std::span<const int> vertices, double edge_sd_m);

/// Where no reading is near, the boundary's depth proves nothing: there a place is no surer than
/// the field is of it, and what it expects to be wrong there is told apart. Far is twice the radius
/// of the smallest tumour of 0.5 cm2, 8 mm.
Certainty doubted_where_untouched(Certainty certainty, const Belief& belief,
                                  const Marginals& marginals, const Level& level);

}  // namespace palpation
