/// Numbers beside the stops of a plan: in which order they are to be touched.
#pragma once

#include <vector>

#include "draw/outcome.h"
#include "draw/sheet.h"
#include "draw/view.h"

namespace palpation::draw {

/// Boxes of these sizes (width, height), each beside its dot, within the map as far as there is
/// room, where they hide least of the dots, of the others and of each other. Earlier ones are
/// placed first.
std::vector<Box> boxes_beside(const std::vector<Pixel>& dots, const std::vector<Pixel>& sizes,
                              const std::vector<Pixel>& others, double radius_px, const Box& map);

/// The indices of planned touches, as waypoints.csv has them, on a map whose dots have that radius.
void draw_stop_numbers(Sheet& sheet, const std::vector<Touch>& touches, const View& view,
                       const Box& map, double radius_px);

}  // namespace palpation::draw
