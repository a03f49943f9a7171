/// First boundaries, and what the readings make of each under each kind of outline.
#pragma once

#include <span>
#include <vector>

#include "certainty/edge_fit.h"
#include "certainty/own_parts.h"
#include "palpation/belief/belief.h"
#include "palpation/certainty/edge_belief.h"

namespace palpation {

/// A first boundary and what it becomes under one kind of outline.
struct Start {
  Prior correction;
  EdgeData data;
  Eigen::MatrixXd prior_covariance;
  EdgeFit edge;
  Eigen::VectorXd distance;  ///< from the first boundary, of the vertices, signed
  double weight = 1.0;       ///< posterior probability
};

/// What is cut for a first boundary, and where.
struct FirstCuts {
  const Field& field;
  std::span<const double> levels;
  double low;  ///< healthy tissue, which parts stand out from
  const OwnParts& parts;
  const std::vector<int>& nearest;  ///< part of each vertex
};

/// For each kind of outline the first boundary that makes the readings most probable, the most
/// likely kind first. Empty where no boundary can be drawn.
std::vector<Start> likely_starts(const Belief& belief, const FirstCuts& cuts, EdgeData all,
                                 const ProfilePrior& profile, const ShapePrior& shape);

}  // namespace palpation
