#include "draw/figure.h"

#include <vtkDataArray.h>

#include <algorithm>
#include <cmath>

#include "draw/layout.h"
#include "draw/legend.h"
#include "palpation/base/error.h"

namespace palpation::draw {
namespace {

constexpr double kCell_px = 584.0;
constexpr double kMapHeight_px = 690.0;
constexpr double kLeftOfMap_px = 70.0;
constexpr double kBelowMap_px = 66.0;
constexpr double kTitle_px = 54.0;
constexpr double kName_px = 40.0;
constexpr double kFoot_px = 14.0;
constexpr double kRight_px = 24.0;  // fonts of other programs are wider
constexpr double kMostPixels = 12'000.0;
constexpr double kMmPerInch = 25.4;

/// A map in its cell, as large as fits, its foot on the bottom.
Box fitted(const View& view, double left, double bottom) {
  const double room = kCell_px - kLeftOfMap_px - kRightOfMap_px;
  const double scale = std::min(room / view.width_mm, kMapHeight_px / view.height_mm);
  const double width = std::max(1.0, std::floor(scale * view.width_mm));
  const double height = std::max(1.0, std::floor(scale * view.height_mm));
  return {std::floor(left + kLeftOfMap_px + (room - width) / 2.0), bottom, width, height};
}

std::vector<double> values_of(const Outcome& outcome, const char* name) {
  std::vector<double> values;
  vtkDataArray* field = outcome.field(name);
  for (vtkIdType i = 0; field != nullptr && i < field->GetNumberOfTuples(); ++i)
    values.push_back(field->GetComponent(i, 0));
  return values;
}

/// Limits that hold those of each run.
ColourWish common_limits(const std::vector<Outcome>& outcomes, ColourWish wish) {
  std::optional<results::Limits> mean, stddev;
  const auto widen = [](std::optional<results::Limits>& all, const results::Limits& one) {
    all = all ? results::Limits{std::min(all->lowest, one.lowest),
                                std::max(all->highest, one.highest)}
              : one;
  };
  for (const Outcome& outcome : outcomes) {
    const bool has_slope = outcome.field("mean_detrended") != nullptr;
    widen(mean,
          results::limits_of_mean(values_of(outcome, has_slope ? "mean_detrended" : "mean"),
                                  outcome.summary.level, outcome.summary.noise_sd.value_or(0.0)));
    widen(stddev, results::limits_from_zero(values_of(outcome, "stddev")));
  }
  if (!wish.mean_limits) wish.mean_limits = mean;
  if (!wish.stddev_limits) wish.stddev_limits = stddev;
  return wish;
}

/// Which run and which panel stand where.
struct Place {
  std::size_t run = 0, panel = 0;
  int column = 0, row = 0;
};

std::vector<Place> places_of(std::size_t runs, std::size_t panels) {
  std::vector<Place> places;
  for (std::size_t run = 0; run < runs; ++run)
    for (std::size_t panel = 0; panel < panels; ++panel)
      places.push_back(runs == 1
                           ? Place{run, panel, static_cast<int>(panel), 0}
                           : Place{run, panel, static_cast<int>(run), static_cast<int>(panel)});
  return places;
}

std::string letter_of(const Place& place, int columns) {
  const int number = place.row * columns + place.column;
  return number < 26 ? std::string(1, static_cast<char>('a' + number)) : std::to_string(number + 1);
}

}  // namespace

std::string figure_of(const std::vector<Outcome>& outcomes, const std::vector<std::string>& names,
                      const FigureOptions& options) {
  require(!outcomes.empty() && !options.panels.empty(), "figure_of", "runs and panels",
          "must be at least one each");
  const bool compares = outcomes.size() > 1;
  const ColourWish wish = compares ? common_limits(outcomes, options.colours) : options.colours;
  std::vector<PanelPlan> plans;
  for (const Outcome& outcome : outcomes) plans.push_back(plan_of(outcome, wish));
  const std::vector<Place> places = places_of(outcomes.size(), options.panels.size());
  const int columns = places.back().column + 1, rows = places.back().row + 1;
  std::vector<double> heights(static_cast<std::size_t>(rows), 0.0);
  const auto view_at = [&](const Place& place) -> const View& {
    return view_in(plans[place.run], options.panels[place.panel]);
  };
  for (const Place& place : places) {
    double& height = heights[static_cast<std::size_t>(place.row)];
    height = std::max(height, fitted(view_at(place), 0.0, 0.0).height);
  }
  const double width = std::max(kCell_px * columns + kRight_px, 700.0);
  const auto legend = legend_rows(outcomes.front(), width - 48.0);
  const double foot = kFoot_px + kLegendRow_px * static_cast<double>(legend.size());
  double height = foot + (compares ? kName_px : 0.0);
  for (const double map : heights) height += kBelowMap_px + map + kTitle_px;
  const double scale = options.width_mm / kMmPerInch * options.dots_per_inch / width;
  require(scale * std::max(width, height) <= kMostPixels, "figure_of",
          text_of(options.width_mm) + " mm at " + text_of(options.dots_per_inch) + " dots per inch",
          "must be at most 12,000 pixels along a side");
  Sheet sheet(static_cast<int>(width), static_cast<int>(std::ceil(height)), scale);
  for (const Place& place : places) {
    double bottom = foot + kBelowMap_px;
    for (int row = rows - 1; row > place.row; --row)
      bottom += heights[static_cast<std::size_t>(row)] + kTitle_px + kBelowMap_px;
    const Box map = fitted(view_at(place),
                           (width - kRight_px - kCell_px * columns) / 2.0 + kCell_px * place.column,
                           std::floor(bottom));
    draw_panel(sheet, outcomes[place.run], plans[place.run], options.panels[place.panel], map,
               letter_of(place, columns));
    if (compares && place.row == 0)
      sheet.text({map.centre().x(), height - kName_px / 2.0}, names[place.run],
                 {.size_px = 20.0, .bold = true, .horizontal = Horizontal::Centre});
  }
  draw_legend(sheet, legend, kFoot_px);
  switch (options.format) {
    case Format::Svg:
      return svg_of(sheet.page(), options.width_mm);
    case Format::Pdf:
      return pdf_of(sheet.page(), options.width_mm);
    case Format::Png:
      break;
  }
  return sheet.png();
}

}  // namespace palpation::draw
