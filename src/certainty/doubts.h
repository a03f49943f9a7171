/// What makes a boundary less sure, or another, than its readings by themselves: a tip, fading
/// contact, a robot's registration, parts that may be none, and places that nobody touched.
#pragma once

#include <optional>
#include <span>

#include "palpation/certainty/certainty.h"
#include "readings/contact.h"

namespace palpation {

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

/// Another answer is as likely as this one, and no reading tells which: here its score, or nothing
/// where it has no tumour. Where one is inside and the other is not, a place is as likely tumour as
/// not; elsewhere it is as sure as the less sure of both. Half of what the other has elsewhere
/// counts as wrong.
Certainty as_likely_another(Certainty certainty, const Surface& surface,
                            const std::optional<Field>& other_score);

/// Where no reading is near, the boundary's depth proves nothing: there a place is no surer than
/// the field is of it, and what it expects to be wrong there is told apart. Far is twice the radius
/// of the smallest tumour of 0.5 cm2, 8 mm.
Certainty doubted_where_untouched(Certainty certainty, const Belief& belief,
                                  const Marginals& marginals, const Level& level);

}  // namespace palpation
