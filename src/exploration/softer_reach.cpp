#include "exploration/softer_reach.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "certainty/own_parts.h"
#include "exploration/find_boundary.h"

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

/// How much farther out than a boundary its profile has come down to this part of its height.
double farther_out_m(double fraction, double part, double slope_per_m) {
  const auto logit = [](double share) { return std::log(share / (1.0 - share)); };
  return (logit(fraction) - logit(part * fraction)) / slope_per_m;
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
  const double farther_m = farther_out_m(fraction, kLeastCut, profile.slope_per_m);
  const Surface& surface = conclusion.belief.prior().surface();
  double area_m2 = 0.0;
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    if (of_all->depth()[vertex] >= 0.0 && edge.depth()[vertex] < -farther_m)
      area_m2 += surface.vertex_areas()[vertex];
  }
  const double unexplained_m2 = std::max(area_m2 - of_all->expected_error_m2(), 0.0);
  return SofterReach{*std::move(of_all), unexplained_m2};
}

}  // namespace palpation
