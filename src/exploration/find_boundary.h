/// From the field to the tumour's boundary.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "exploration/believe.h"

namespace palpation {

/// The level, and where it is inferred from the tumour's edge what is known of that.
struct BoundaryFit {
  std::optional<Level> level{};
  std::optional<EdgeBelief> edge{};
  std::optional<OutlinePosterior> outlines{};

  /// Positive inside; null where the boundary is not inferred from its edge.
  const Field* depth() const;
  /// What the certainty's score divides it by; null as there.
  const Field* offset_sd() const;
};

/// Of the readings' range or edge, or as it is known. `component`: what the level cuts, at the
/// vertices. Without outlines.
BoundaryFit find_boundary(const Surface& surface, const Model& model, const Believed& believed,
                          const Marginals& component);

/// EdgeBelief::around, as a model has it.
std::optional<EdgeBelief> edge_around(const Model& model, const Belief& belief,
                                      const Marginals& component,
                                      const std::vector<double>& first_levels,
                                      const ShapePrior& shape = {});

/// How the boundary's outlines are drawn.
OutlineOptions outline_options(const Model& model, const Believed& believed, std::uint64_t seed);

/// Adds outlines, and takes the level from them, where the boundary has an edge.
void draw_outlines(BoundaryFit& boundary, const Model& model, const Believed& believed,
                   std::uint64_t seed);

/// How sure that is, what fades, what a tip feels early and what is far from any reading included.
/// Needs a level.
Certainty certainty_of(const Surface& surface, const Model& model, const Believed& believed,
                       const Marginals& component, const BoundaryFit& boundary);

}  // namespace palpation
