/// What drawn outlines say of a tumour's core.
#pragma once

#include <optional>
#include <vector>

#include "certainty/outline_walk.h"
#include "palpation/certainty/outline_posterior.h"

namespace palpation {

/// Nothing where they have none. `depths`: of each draw, a row, at the vertices.
std::optional<DrawnCore> core_of(const Surface& surface, const std::vector<OutlineDraw>& draws,
                                 const Eigen::MatrixXf& depths);

/// Of numbers, one a draw.
DrawnNumber summed_up(std::vector<double> numbers);

}  // namespace palpation
