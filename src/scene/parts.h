/// The parts of an estimated tumour, each with what a person asks of it: where, how large, whether
/// it is there at all.
#pragma once

#include <optional>
#include <vector>

#include "scene/episode.h"

namespace palpation::tool {

/// The area on the tissue, lengths and places in the chart.
struct TumourPart {
  PolygonWithHoles polygon;
  double area_m2 = 0.0;                                ///< without its holes
  Vec2 centroid_m = Vec2::Zero();                      ///< of that area
  Vec2 least_m = Vec2::Zero(), most_m = Vec2::Zero();  ///< corners of its bounding box
  Vec3 position_m = Vec3::Zero();  ///< on the tissue: of the vertex nearest to the centroid
  /// That it exists: of its surest place to be tumour; nothing where no certainty is asked for.
  std::optional<double> probability{};
  bool touches_border = false;             ///< of the tissue, beyond which it may go on
  std::optional<PartContrast> contrast{};  ///< where parts have contrasts of their own
};

/// By falling area, as Region lists them. None where nothing was found.
std::vector<TumourPart> parts_of(const Episode& episode);

/// Of a place in the chart.
bool winds_around(const Ring& ring, const Vec2& place);
bool contains(const PolygonWithHoles& polygon, const Vec2& place);

/// A ring as a part of its own, without probability.
TumourPart measured(const Ring& ring, const Surface& surface);

}  // namespace palpation::tool
