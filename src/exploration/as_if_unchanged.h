/// What readings say as if neither sensor nor tissue had changed while they were made.
#pragma once

#include <span>
#include <vector>

#include "exploration/believe.h"
#include "exploration/find_boundary.h"

namespace palpation {

/// All but outlines and certainty.
struct Known {
  Believed believed;
  Marginals marginals;
  Marginals component;  ///< as Conclusion has it
  BoundaryFit boundary;
};

Known known_by(const Surface& surface, const Model& model, Believed believed);

/// A zero that moved and tissue that slopes are seen at once, and taken back. Whether a gain
/// changed or the tissue moved costs a tenth of a second to ask, and is asked, and taken back,
/// where `is_last`.
Known known_as_if_unchanged(const Surface& surface, const Model& model,
                            const std::vector<Palpation>& felt, ConclusionCache& cache,
                            bool is_last);

}  // namespace palpation
