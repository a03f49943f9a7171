#include "scene/reachable.h"

#include <cmath>

#include "palpation/certainty/reference_bound.h"

namespace palpation::tool {
namespace {

constexpr double kNoNoise = 1e-3;  // of the contrast: so little does not limit what they reach

double perimeter_m(const Region& region) {
  double sum = 0.0;
  const auto add = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i)
      sum += (ring[(i + 1) % ring.size()] - ring[i]).norm();
  };
  for (const PolygonWithHoles& polygon : region.polygons()) {
    add(polygon.outer);
    for (const Ring& hole : polygon.holes) add(hole);
  }
  return sum;
}

}  // namespace

std::optional<double> over_reachable(const Episode& episode) {
  const std::optional<EdgeBelief>& edge = episode.conclusion().edge;
  const std::optional<Certainty>& certainty = episode.conclusion().certainty;
  const double length_m = perimeter_m(episode.estimate);
  if (!edge || !certainty || length_m == 0.0) return std::nullopt;
  const double contrast = std::abs(edge->profile().high - edge->profile().low),
               noise_sd = std::sqrt(edge->noise_variance());
  const ReferenceBound reachable =
      reference_bound({.perimeter_m = length_m,
                       .slope_per_m = edge->profile().slope_per_m,
                       .noise = noise_sd / contrast,
                       .readings = episode.conclusion().belief.site_count(),
                       .fraction = episode.conclusion().model.level.fraction});
  const bool has_noise = noise_sd > kNoNoise * contrast;
  if (!has_noise || !(reachable.expected_error_m2 > 0.0)) return std::nullopt;
  return certainty->expected.symmetric_difference_m2() / reachable.expected_error_m2;
}

}  // namespace palpation::tool
