#include "draw/panels.h"

#include <vtkDataArray.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "draw/axis.h"
#include "draw/layout.h"
#include "draw/look.h"
#include "draw/ruler.h"
#include "draw/stop_numbers.h"
#include "draw/tissue_view.h"
#include "palpation/base/error.h"

namespace palpation::draw {
namespace {

constexpr const char* kSquareMm = " mm\u00b2";
constexpr const char* kPlusMinus = "\u00b1 ";

// Dots shrink where there are many, and on a small map, so that they do not hide it.
double touch_radius_px(std::size_t count, const Box& map) {
  constexpr double kLargest_px = 5.2;
  const double crowd = std::sqrt(150.0 / std::max(150.0, static_cast<double>(count)));
  const double room = std::clamp(std::sqrt(map.width * map.height / (340.0 * 680.0)), 0.75, 1.0);
  return std::max(1.1, kLargest_px * crowd * room);
}

Third third_panel(const Outcome& outcome, const PanelPlan& plan) {
  if (outcome.shows_band()) return Third::Band;
  if (plan.level && plan.truth_level && outcome.field("truth") != nullptr) return Third::Margins;
  return outcome.field("probability_inside") != nullptr ? Third::Probability : Third::Mean;
}

std::vector<double> values_of(vtkDataArray& field) {
  std::vector<double> values;
  for (vtkIdType i = 0; i < field.GetNumberOfTuples(); ++i)
    values.push_back(field.GetComponent(i, 0));
  return values;
}

// White is the level, so that the boundary runs where the colour turns.
ColourScale scale_of_mean(vtkDataArray& mean, const Outcome& outcome, const PanelPlan& plan) {
  const results::Limits limits = plan.wish.mean_limits.value_or(
      results::limits_of_mean(values_of(mean), plan.level, outcome.summary.noise_sd.value_or(0.0)));
  return {Palette::BlueWhiteRed, limits.lowest, limits.highest};
}

ColourScale scale_of_uncertainty(vtkDataArray& field, bool starts_at_zero, const PanelPlan& plan) {
  const std::vector<double> values = values_of(field);
  const results::Limits limits =
      starts_at_zero ? plan.wish.stddev_limits.value_or(results::limits_from_zero(values))
                     : results::limits_of_mean(values, std::nullopt, 0.0);
  return {Palette::Viridis, limits.lowest, limits.highest};
}

void draw_title(Sheet& sheet, const Box& map, const std::string& letter, const std::string& words) {
  const Pixel place(map.left, map.top() + 22.0);
  const TextStyle bold{.size_px = 22.0, .bold = true};
  const Pixel first_word = place + Pixel(text_width_px(letter, bold) + 10.0, 0.0);
  const double room_px = map.right() + kRightOfMap_px - first_word.x();
  const double width_px = text_width_px(words, {.size_px = 22.0});
  sheet.text(place, letter, bold);
  sheet.text(first_word, words, {.size_px = 22.0 * std::min(1.0, room_px / width_px)});
}

void draw_boundaries(TissueScene& scene, const Outcome& outcome, bool with_truth) {
  scene.draw_border(kRim);
  if (!outcome.shows_band()) {
    scene.draw_curves(outcome, "band_inner", kBandLine);
    scene.draw_curves(outcome, "band_outer", kBandLine);
  }
  scene.draw_curves(outcome, "estimate", kEstimateHalo);
  scene.draw_curves(outcome, "estimate", kEstimateLine);
  if (!with_truth) return;
  scene.draw_curves(outcome, "truth", kTruthHalo);
  scene.draw_curves(outcome, "truth", kTruthLine);
}

std::string unit_of(const Outcome& outcome) {
  return outcome.summary.reading_unit.empty() ? "unit of the readings"
                                              : outcome.summary.reading_unit;
}

std::vector<Touch> planned_of(const std::vector<Touch>& touches) {
  std::vector<Touch> planned;
  std::copy_if(touches.begin(), touches.end(), std::back_inserter(planned),
               [](const Touch& touch) { return touch.planned; });
  return planned;
}

void draw_mean(Sheet& sheet, const Outcome& outcome, const PanelPlan& plan, const Box& map,
               const std::string& letter, bool with_touches) {
  vtkDataArray* detrended =
      outcome.field("mean_detrended");  // what the level cuts, where there is a trend
  vtkDataArray& mean = detrended != nullptr ? *detrended : *outcome.field("mean");
  const ColourScale scale = scale_of_mean(mean, outcome, plan);
  const double radius_px = touch_radius_px(outcome.touches.size(), map);
  TissueScene scene(sheet.scene(map), plan.view, map);
  scene.paint_field(outcome, mean, scale);
  scene.draw_not_searched(outcome);
  if (with_touches) scene.draw_touches(outcome.touches, radius_px);
  draw_boundaries(scene, outcome, /*with_truth=*/true);
  if (with_touches) scene.draw_touches(planned_of(outcome.touches), radius_px);
  scene.finish();
  if (with_touches) draw_stop_numbers(sheet, outcome.touches, plan.view, map, radius_px);
  draw_title(sheet, map, letter,
             with_touches ? "Estimated stiffness (posterior mean)"
             : plan.level ? "Estimated boundary"
                          : "Nothing found");
  draw_ruler(sheet, plan.view, map);
  draw_colour_bar(sheet, map, scale, unit_of(outcome), plan.level);
}

void draw_uncertainty(Sheet& sheet, const Outcome& outcome, const PanelPlan& plan, const Box& map,
                      const std::string& letter) {
  const bool has_stddev = outcome.field("stddev") != nullptr;
  vtkDataArray* field = has_stddev ? outcome.field("stddev") : outcome.field("acquisition");
  if (field == nullptr) {
    draw_mean(sheet, outcome, plan, map, letter, /*with_touches=*/false);
    return;
  }
  const ColourScale scale = scale_of_uncertainty(*field, has_stddev, plan);
  const double radius_px = touch_radius_px(outcome.touches.size(), map);
  TissueScene scene(sheet.scene(map), plan.view, map);
  scene.paint_field(outcome, *field, scale);
  scene.draw_not_searched(outcome);
  scene.draw_border(kRim);
  scene.draw_touches(outcome.touches, radius_px);
  scene.finish();
  draw_stop_numbers(sheet, outcome.touches, plan.view, map, radius_px);
  draw_title(sheet, map, letter,
             has_stddev ? "Posterior standard deviation" : "Acquisition function");
  draw_ruler(sheet, plan.view, map);
  draw_colour_bar(sheet, map, scale, has_stddev ? unit_of(outcome) : "", std::nullopt);
}

void draw_patch_key(Sheet& sheet, const Pixel& place, Colour colour, const std::string& name,
                    const std::optional<double>& area_mm2) {
  const Box patch{place.x(), place.y() - 9.0, 24.0, 18.0};
  sheet.fill(patch, colour);
  sheet.frame(patch, kFrame);
  sheet.text(place + Pixel(32.0, 0.0), name, {.size_px = 16.0});
  if (area_mm2)
    sheet.text(place + Pixel(0.0, -22.0), short_number(*area_mm2, 3) + kSquareMm,
               {.size_px = 16.0, .colour = kGrey});
}

void draw_margin_keys(Sheet& sheet, const Outcome& outcome, const Box& map) {
  const ErrorNumbers error = outcome.summary.error.value_or(ErrorNumbers{});
  const Pixel first(map.right() + 14.0, map.centre().y() + 92.0);
  const Pixel down(0.0, -62.0);
  draw_patch_key(sheet, first, kMissed, "missed", error.missed_mm2);
  draw_patch_key(sheet, first + down, kExtra, "extra", error.extra_mm2);
  draw_patch_key(sheet, first + 2.0 * down, kAgreement, "both", std::nullopt);
  draw_patch_key(sheet, first + 2.6 * down, kHealthy, "neither", std::nullopt);
}

void draw_margins(Sheet& sheet, const Outcome& outcome, const PanelPlan& plan, const Box& map,
                  const std::string& letter) {
  TissueScene scene(sheet.scene(map), plan.view, map);
  scene.paint_margins(outcome, *plan.level, *plan.truth_level);
  scene.draw_border(kRim);
  scene.draw_curves(outcome, "estimate", kMarginLine);
  scene.finish();
  draw_title(sheet, map, letter, "Missed and extra area");
  draw_ruler(sheet, plan.view, map);
  draw_margin_keys(sheet, outcome, map);
}

void draw_zone_keys(Sheet& sheet, const BandNumbers& band, const Box& map) {
  const Pixel first(map.right() + 14.0, map.centre().y() + 92.0);
  const Pixel down(0.0, -62.0);
  draw_patch_key(sheet, first, kSurelyTumour, "certain", band.inner_area_mm2);
  draw_patch_key(sheet, first + down, kUnsure, "uncertain", std::nullopt);
  if (band.half_width_mm)
    sheet.text(first + down + Pixel(0.0, -22.0),
               kPlusMinus + short_number(*band.half_width_mm, 2) + " mm",
               {.size_px = 16.0, .colour = kGrey});
  draw_patch_key(sheet, first + 2.0 * down, kHealthy, "healthy", std::nullopt);
}

/// Where to cut: what is tumour as good as surely, what is healthy as good as surely, and the band
/// between.
void draw_band(Sheet& sheet, const Outcome& outcome, const PanelPlan& plan, const Box& map,
               const std::string& letter) {
  const BandNumbers& band = *outcome.summary.band;
  TissueScene scene(sheet.scene(map), plan.close_up, map);
  scene.paint_zones(outcome, *band.score);
  scene.draw_not_searched(outcome);
  scene.draw_border(kRim);
  scene.draw_curves(outcome, "estimate", kMarginLine);
  scene.draw_curves(outcome, "cut", kCutHalo);
  scene.draw_curves(outcome, "cut", kCutLine);
  scene.draw_curves(outcome, "truth", kTruthLine);
  scene.finish();
  draw_title(sheet, map, letter,
             band.probability ? "Tumour boundary, " + short_number(100.0 * *band.probability, 3) +
                                    " % confidence band"
                              : "Tumour boundary, confidence band");
  draw_ruler(sheet, plan.close_up, map);
  if (plan.close_up.width_mm < plan.view.width_mm) sheet.frame(map, kFrame);
  draw_zone_keys(sheet, band, map);
}

void draw_probability(Sheet& sheet, const Outcome& outcome, const PanelPlan& plan, const Box& map,
                      const std::string& letter) {
  const ColourScale scale{Palette::WhitePurple, 0.0, 1.0};
  TissueScene scene(sheet.scene(map), plan.view, map);
  scene.paint_field(outcome, *outcome.field("probability_inside"), scale);
  scene.draw_not_searched(outcome);
  draw_boundaries(scene, outcome, /*with_truth=*/true);
  scene.finish();
  draw_title(sheet, map, letter, "Probability of tumour");
  draw_ruler(sheet, plan.view, map);
  draw_colour_bar(sheet, map, scale, "", std::nullopt);
}

void draw_boundary(Sheet& sheet, const Outcome& outcome, const PanelPlan& plan, const Box& map,
                   const std::string& letter) {
  switch (plan.third) {
    case Third::Band:
      return draw_band(sheet, outcome, plan, map, letter);
    case Third::Margins:
      return draw_margins(sheet, outcome, plan, map, letter);
    case Third::Probability:
      return draw_probability(sheet, outcome, plan, map, letter);
    case Third::Mean:
      return draw_mean(sheet, outcome, plan, map, letter, /*with_touches=*/false);
  }
}

}  // namespace

PanelPlan plan_of(const Outcome& outcome, const ColourWish& wish) {
  if (outcome.field("mean") == nullptr)
    throw IoError("surface.vtp: no field named mean at the points");
  PanelPlan plan{.wish = wish};
  plan.level =
      outcome.summary.level ? outcome.summary.level : outcome.level_along("estimate", "mean");
  plan.truth_level = outcome.level_along("truth", "truth");
  plan.third = third_panel(outcome, plan);
  plan.view = view_of(outcome, plan.level);
  plan.close_up = zoomed_to(plan.view, outcome, {"estimate", "truth", "cut"});
  return plan;
}

const View& view_in(const PanelPlan& plan, Panel panel) {
  return panel == Panel::Boundary && plan.third == Third::Band ? plan.close_up : plan.view;
}

void draw_panel(Sheet& sheet, const Outcome& outcome, const PanelPlan& plan, Panel panel,
                const Box& map, const std::string& letter) {
  switch (panel) {
    case Panel::Mean:
      return draw_mean(sheet, outcome, plan, map, letter, /*with_touches=*/true);
    case Panel::Uncertainty:
      return draw_uncertainty(sheet, outcome, plan, map, letter);
    case Panel::Boundary:
      return draw_boundary(sheet, outcome, plan, map, letter);
  }
}

}  // namespace palpation::draw
