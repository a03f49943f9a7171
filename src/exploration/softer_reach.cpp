#include "exploration/softer_reach.h"

#include <algorithm>
#include <utility>

#include "certainty/own_parts.h"
#include "exploration/find_boundary.h"
#include "palpation/certainty/edge_profile.h"

namespace palpation {
namespace {

/// The belief in readings of which none stands out by more than `top`.
Belief topped(const Belief& belief, double top) {
  std::vector<Palpation> readings = belief.detrended_palpations();
  for (Palpation& one : readings) one.reading = std::min(one.reading, top);
  Kernel kernel = belief.prior().kernel();
  kernel.signal_sd *= kLeastCut;
  return Belief(belief.prior().with(kernel), belief.options()).condition_on(readings);
}

}  // namespace

std::optional<SofterReach> softer_reach(const Conclusion& conclusion) {
  const EdgeBelief& edge = *conclusion.edge;
  const EdgeProfile& profile = edge.profile();
  const double fraction = conclusion.model.level.fraction,
               high = std::min(profile.high, conclusion.component.mean.maxCoeff()),
               top = profile.low + kLeastCut * (high - profile.low);
  if (!(top > profile.low)) return std::nullopt;
  const Belief belief = topped(conclusion.belief, top);
  std::optional<EdgeBelief> of_all =
      edge_around(conclusion.model, belief, belief.at_vertices(Part::Detrended),
                  {profile.low + fraction * (top - profile.low)});
  if (!of_all) return std::nullopt;
  const Surface& surface = conclusion.belief.prior().surface();
  double area_m2 = 0.0;
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    if (of_all->depth()[vertex] >= 0.0 &&
        share_at_depth(profile, edge.depth()[vertex]) < kLeastCut * fraction)
      area_m2 += surface.vertex_areas()[vertex];
  }
  const double unexplained_m2 = std::max(area_m2 - of_all->expected_error_m2(), 0.0);
  return SofterReach{*std::move(of_all), unexplained_m2};
}

}  // namespace palpation
