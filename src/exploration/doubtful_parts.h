/// What may be tumour, and as well be healthy tissue that is stiffer.
#pragma once

#include "palpation/exploration/conclusion.h"

namespace palpation {

/// Adds to a conclusion's certainty, and to `doubtful`, what its edge names as weaker parts
/// (EdgeBelief::misfits) and does not hold: vessels and texture stand out so, and so do tumours.
/// Not where it stands out by a fifth of the strongest's contrast at most, or by less than the
/// model's least contrast, or reaches the border, or contact fades.
void doubt_weaker_parts(Conclusion& conclusion);

/// Makes what was found along a fifth of the tissue's border or more as likely another tissue,
/// which reads alike: an organ beside it, bone that it is held by. They are `doubtful`, too.
void doubt_parts_along_border(Conclusion& conclusion);

}  // namespace palpation
