/// Where everything of a picture goes.
#pragma once

#include <array>
#include <vector>

#include "draw/legend.h"
#include "draw/sheet.h"
#include "draw/tissue_view.h"

namespace palpation::draw {

inline constexpr double kRightOfMap_px =
    108.0;                                   ///< beside a map, for the colour bar with its numbers
inline constexpr double kCaption_px = 50.0;  ///< at the foot of the picture
inline constexpr double kCaptionMargin_px = 24.0;  ///< beside it

struct Layout {
  int width_px = 1800;
  int height_px = 900;
  std::array<Box, 3> maps;
  Box close_up;  ///< in place of the third map: of another view, as large as fits
  std::vector<std::vector<LegendEntry>> legend;
};

/// Three maps at equal scale: side by side on a sheet 1800 pixels wide, or one above the other
/// where the tissue is much wider than high.
Layout layout_of(const Outcome& outcome, const View& view, const View& close_up);

}  // namespace palpation::draw
