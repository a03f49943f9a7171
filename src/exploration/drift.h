/// A sensor that drifts: errors that last over some readings, in the order in which they were made.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "certainty/edge_data.h"

namespace palpation {

/// Errors (errors_in_turn.h) of each of the first `count` readings that two parallel lines on which
/// the readings lie share, as time goes on (parallel_surfaces.h); those that are likelier than two
/// level lines by `needed` nats, the likeliest first, `most` at most. Nothing for fewer than
/// fifteen places, or where all readings are alike.
std::vector<Eigen::VectorXd> drifts_of_parallel_lines(const EdgeData& readings, Eigen::Index count,
                                                      double needed, std::size_t most);

}  // namespace palpation
