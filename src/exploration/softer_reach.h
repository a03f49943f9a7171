/// How far softer tissue reaches about or beside what was found.
///
/// The line half way up to the highest plateau passes through a softer rim or lobe that reads
/// about half as much, and touches along it never feel where that ends. Topped at the least
/// contrast that is cut out, readings of all such tissue lie on one plateau, whose edge is where
/// the softest of them ends; of tissue of one height it is the same edge, farther out by as much as
/// its slope tells.
#pragma once

#include <optional>

#include "palpation/exploration/conclusion.h"

namespace palpation {

struct SofterReach {
  EdgeBelief edge;  ///< of the topped readings
  /// Within it and farther out than one height explains, less what is not known of it.
  double unexplained_m2 = 0.0;
};

/// Nothing where no such edge can be drawn. Needs the conclusion's edge.
std::optional<SofterReach> softer_reach(const Conclusion& conclusion);

}  // namespace palpation
