/// What the lines and dots of a picture mean: only those that occur in it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw/outcome.h"
#include "draw/sheet.h"
#include "draw/tissue_view.h"

namespace palpation::draw {

struct LegendEntry {
  std::string words;
  std::vector<LineStyle> lines;  ///< one above the other
  std::optional<TouchLook> touch;
  bool hatched = false;  ///< a patch of what was not searched
};

inline constexpr double kLegendRow_px = 34.0;

/// The entries, broken into rows that fit into a width.
std::vector<std::vector<LegendEntry>> legend_rows(const Outcome& outcome, double width_px);

/// Draws the rows, centred on the sheet, the lowest row's foot at bottom_px.
void draw_legend(Sheet& sheet, const std::vector<std::vector<LegendEntry>>& rows, double bottom_px);

}  // namespace palpation::draw
