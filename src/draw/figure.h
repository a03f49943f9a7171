/// Figures for papers: panels of one run or of several, in one row or in columns, by one measure.
#pragma once

#include <string>
#include <vector>

#include "draw/outcome.h"
#include "draw/panels.h"

namespace palpation::draw {

enum class Format { Png, Svg, Pdf };

struct FigureOptions {
  std::vector<Panel> panels{Panel::Mean, Panel::Uncertainty, Panel::Boundary};
  Format format = Format::Png;
  double width_mm = 180.0;
  double dots_per_inch = 300.0;  ///< of a PNG, and of the maps in the others
  ColourWish colours{};          ///< of several runs left out: common ones, that hold all of them
};

/// The bytes of the file. One run: its panels in a row. Several: each a column, with a row for each
/// panel. Throws IoError where a surface holds no field named mean, InvalidInput without runs or
/// panels, or for more than 12,000 pixels along a side, NoGraphics.
std::string figure_of(const std::vector<Outcome>& outcomes, const std::vector<std::string>& names,
                      const FigureOptions& options);

}  // namespace palpation::draw
