/// Curves over a common x axis: how an error falls with the number of measurements.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw/table.h"

namespace palpation::draw {

struct ChartCurve {
  std::string name;
  std::vector<double> y;   ///< one for every x; NaN leaves a gap
  std::vector<double> se;  ///< standard errors, one for every x, or none at all
};

enum class Spread { Bars, Band, None };  ///< how standard errors are shown

struct Chart {
  std::string title, x_label, y_label;
  std::vector<double> x;
  std::vector<ChartCurve> curves;
  bool logarithmic_y = false;
  Spread spread = Spread::Bars;
  int width_px = 1100;
  int height_px = 760;
};

/// Bytes of a PNG file. On a linear axis y starts at zero if no value is negative and the values
/// reach down to half their height; on a logarithmic one, values that are not positive are left
/// out. Throws InvalidInput if there is nothing to draw, NoGraphics if nothing can be drawn here.
std::string picture_of(const Chart& chart);

/// From a table whose first column is x, and every other column `name` a curve, with standard
/// errors in `name_se` where that exists.
Chart chart_of(const Table& table);

/// Error in percent against measurements, or the level where no error is known. None if the table
/// has fewer than two rows that can be drawn.
std::optional<Chart> convergence_of(const Table& trace);

}  // namespace palpation::draw
