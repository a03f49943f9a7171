// What was not found, and how large it would have had to be to be found.
#include <cmath>

#include "palpation/certainty/detection.h"
#include "tool/episode.h"

namespace palpation::tool {
namespace {

/// Standard deviation; 0 for readings that are all alike.
double scatter(const std::vector<double>& readings) {
  const double count = static_cast<double>(readings.size());
  double mean = 0.0, square = 0.0;
  for (const double reading : readings) mean += reading / count;
  for (const double reading : readings) square += (reading - mean) * (reading - mean) / count;
  return std::sqrt(square);
}

/// The tissue outside of what was found.
struct Healthy {
  std::vector<int> vertices;
  double mean = 0.0;  ///< of the field over it
};

Healthy healthy_part(const Exploration& exploration) {
  Healthy healthy;
  double area = 0.0;
  for (int vertex = 0; vertex < exploration.surface().vertex_count(); ++vertex) {
    if (exploration.certainty()->score[vertex] >= 0.0) continue;
    healthy.vertices.push_back(vertex);
    const double share = exploration.surface().vertex_areas()[vertex];
    healthy.mean += share * exploration.component().mean[vertex];
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

std::optional<double> diameter_ruled_out_m(const Episode& episode) {
  const Exploration& exploration = episode.exploration;
  const Surface& surface = exploration.surface();
  if (exploration.belief().site_count() == 0) return std::nullopt;
  const Layout layout(exploration.belief().prior());
  std::vector<Vec3> places;
  std::vector<double> readings;
  for (const Palpation& palpation : exploration.belief().detrended_palpations()) {
    if (!palpation.set_aside.empty()) continue;
    places.push_back(layout.at(palpation.where));
    readings.push_back(palpation.reading);
  }
  Sought sought{.probability = episode.band_probability};
  if (!exploration.level()) {
    if (episode.assumed_contrast) sought.contrast_to_noise = *episode.assumed_contrast / scatter(readings);
    return within(surface, palpation::diameter_ruled_out_m(layout, places, sought));
  }
  const Healthy healthy = healthy_part(exploration);
  if (healthy.vertices.empty() || exploration.tip_hides_all()) return std::nullopt;
  const double contrast = episode.assumed_contrast.value_or((exploration.level()->value - healthy.mean) / episode.level_fraction);
  sought.contrast_to_noise = contrast / std::sqrt(exploration.belief().noise_variance());
  if (!(sought.contrast_to_noise > 0.0)) return std::nullopt;
  return within(surface, palpation::diameter_ruled_out_m(layout, places, sought, healthy.vertices));
}

}  // namespace palpation::tool
