// What was not found, and how large it would have had to be to be found.
#include <algorithm>
#include <cmath>

#include "certainty/detection.h"
#include "readings/readings.h"
#include "scene/episode.h"

namespace palpation::tool {
namespace {

/// The tissue outside of what was found.
struct Healthy {
  std::vector<int> vertices;
  double mean = 0.0;  ///< of the field over it
};

Healthy healthy_part(const Exploration& exploration) {
  Healthy healthy;
  double area = 0.0;
  for (int vertex = 0; vertex < exploration.surface().vertex_count(); ++vertex) {
    if (exploration.conclusion().certainty->score[vertex] >= 0.0) continue;
    healthy.vertices.push_back(vertex);
    const double share = exploration.surface().vertex_areas()[vertex];
    healthy.mean += share * exploration.conclusion().component.mean[vertex];
    area += share;
  }
  if (area > 0.0) healthy.mean /= area;
  return healthy;
}

/// A tumour wider than the tissue is none to rule out.
std::optional<double> within(const Surface& surface, const std::optional<double>& diameter_m) {
  return diameter_m && *diameter_m < surface.diameter() ? diameter_m : std::nullopt;
}

}  // namespace

std::vector<double> readings_that_count(const Exploration& exploration) {
  return used_readings(exploration.conclusion().belief.detrended_palpations());
}

double scatter(const Exploration& exploration) {
  const double seen = spread_of(readings_that_count(exploration)).sd;
  const bool is_given = !exploration.conclusion().model.field.noise.sd.is_learned();
  return seen > 0.0 && is_given
             ? std::max(seen, std::sqrt(exploration.conclusion().belief.noise_variance()))
             : seen;
}

std::optional<double> diameter_ruled_out_m(const Episode& episode) {
  const Exploration& exploration = episode.exploration;
  const Surface& surface = exploration.surface();
  if (exploration.conclusion().belief.site_count() == 0) return std::nullopt;
  const Layout layout(exploration.conclusion().belief.prior());
  const std::vector<Vec3> places = layout.touched(exploration.conclusion().belief.palpations());
  Sought sought{.probability = episode.band_probability};
  if (!exploration.conclusion().level) {
    const double noise_sd = scatter(exploration);
    if (noise_sd == 0.0) return std::nullopt;  // a stuck sensor rules nothing out
    if (episode.min_contrast) sought.contrast_to_noise = *episode.min_contrast / noise_sd;
    return within(surface, palpation::diameter_ruled_out_m(layout, places, sought));
  }
  const Healthy healthy = healthy_part(exploration);
  if (healthy.vertices.empty() || exploration.conclusion().tip_hides_all) return std::nullopt;
  const double contrast = episode.min_contrast.value_or(
      (exploration.conclusion().level->value - healthy.mean) / episode.level_fraction);
  sought.contrast_to_noise = contrast / std::sqrt(exploration.conclusion().belief.noise_variance());
  if (!(sought.contrast_to_noise > 0.0)) return std::nullopt;
  return within(surface, palpation::diameter_ruled_out_m(layout, places, sought, healthy.vertices));
}

}  // namespace palpation::tool
