/// What a map is measured by: axes or a scale bar, and the scale of its colours.
#pragma once

#include <optional>
#include <string>

#include "draw/colour.h"
#include "draw/sheet.h"
#include "draw/tissue_view.h"

namespace palpation::draw {

/// Axes in millimetres around flat tissue; a scale bar under curved tissue.
void draw_ruler(Sheet& sheet, const View& view, const Box& map);

/// Right of the map: the colours with their numbers, what they are of, and a mark at one of them.
void draw_colour_bar(Sheet& sheet, const Box& map, const ColourScale& scale,
                     const std::string& unit, std::optional<double> mark);

}  // namespace palpation::draw
