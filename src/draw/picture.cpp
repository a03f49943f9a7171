#include "draw/picture.h"

#include <vtkDataArray.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "draw/axis.h"
#include "draw/layout.h"
#include "draw/look.h"
#include "draw/sheet.h"
#include "draw/tissue_view.h"
#include "palpation/base/error.h"

namespace palpation::draw {
namespace {

constexpr const char* kSquareMm = " mm\u00b2";
constexpr const char* kPlusMinus = "\u00b1 ";

enum class Third { Band, Margins, Probability, Mean };

struct Plan {
  std::optional<double> level;        // of the estimate
  std::optional<double> truth_level;  // of the truth
  Third third = Third::Mean;
  View view;
  View close_up;  // of the boundary
  double touch_radius_px = 4.0;
  Layout layout;
};

// Dots shrink where there are many, and on a small map, so that they do not hide it.
double touch_radius_px(std::size_t count, const Box& map) {
  constexpr double kLargest_px = 5.2;
  const double crowd = std::sqrt(150.0 / std::max(150.0, static_cast<double>(count)));
  const double room = std::clamp(std::sqrt(map.width * map.height / (340.0 * 680.0)), 0.75, 1.0);
  return std::max(1.1, kLargest_px * crowd * room);
}

Third third_panel(const Outcome& outcome, const Plan& plan) {
  if (outcome.shows_band()) return Third::Band;
  if (plan.level && plan.truth_level && outcome.field("truth") != nullptr) return Third::Margins;
  return outcome.field("probability_inside") != nullptr ? Third::Probability : Third::Mean;
}

struct Range {
  double lowest = 0.0, highest = 1.0;
};

// Widened a little where the field is constant, so that a scale has two ends.
Range range_of(vtkDataArray& field) {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (vtkIdType i = 0; i < field.GetNumberOfTuples(); ++i) {
    const double value = field.GetComponent(i, 0);
    if (!std::isfinite(value)) continue;
    range.lowest = std::min(range.lowest, value);
    range.highest = std::max(range.highest, value);
  }
  if (range.lowest > range.highest) return {};
  const double least_width =
      std::max(1e-9 * std::max(std::abs(range.lowest), std::abs(range.highest)), 1e-12);
  if (range.highest - range.lowest < least_width)
    return {range.lowest - least_width, range.highest + least_width};
  return range;
}

// White is the level, so that the boundary runs where the colour turns.
ColourScale scale_of_mean(vtkDataArray& mean, std::optional<double> level) {
  const Range range = range_of(mean);
  const double middle = level.value_or((range.lowest + range.highest) / 2.0);
  const double half = std::max({range.highest - middle, middle - range.lowest, 1e-12});
  return {Palette::BlueWhiteRed, middle - half, middle + half};
}

ColourScale scale_of_uncertainty(vtkDataArray& field, bool starts_at_zero) {
  const Range range = range_of(field);
  return {Palette::Viridis, starts_at_zero ? std::min(0.0, range.lowest) : range.lowest,
          range.highest};
}

Plan plan_of(const Outcome& outcome) {
  Plan plan;
  plan.level =
      outcome.summary.level ? outcome.summary.level : outcome.level_along("estimate", "mean");
  plan.truth_level = outcome.level_along("truth", "truth");
  plan.third = third_panel(outcome, plan);
  plan.view = view_of(outcome, plan.level);
  plan.close_up = zoomed_to(plan.view, outcome, {"estimate", "truth", "cut"});
  plan.layout = layout_of(outcome, plan.view, plan.close_up);
  plan.touch_radius_px = touch_radius_px(outcome.touches.size(), plan.layout.maps[0]);
  return plan;
}

void draw_title(Sheet& sheet, const Box& map, const std::string& letter, const std::string& words) {
  const Pixel place(map.left, map.top() + 22.0);
  const TextStyle bold{.size_px = 22.0, .bold = true};
  sheet.text(place, letter, bold);
  sheet.text(place + Pixel(text_width_px(letter, bold) + 10.0, 0.0), words, {.size_px = 22.0});
}

int tick_count(double length_px) { return std::clamp(static_cast<int>(length_px / 56.0), 4, 9); }

void draw_axes(Sheet& sheet, const View& view, const Box& map) {
  const double px_per_mm = map.width / view.width_mm;
  const bool own_axes = !view.in_chart && view.turn.isIdentity(1e-12);
  for (const Tick& tick :
       ticks(view.left_mm, view.left_mm + view.width_mm, tick_count(map.width))) {
    const Pixel foot(map.left + (tick.value - view.left_mm) * px_per_mm, map.bottom);
    sheet.line(foot, foot - Pixel(0.0, 6.0), kFrame);
    sheet.text(foot - Pixel(0.0, 10.0), tick.label,
               {.size_px = 17.0, .horizontal = Horizontal::Centre, .vertical = Vertical::Top});
  }
  for (const Tick& tick :
       ticks(view.bottom_mm, view.bottom_mm + view.height_mm, tick_count(map.height))) {
    const Pixel foot(map.left, map.bottom + (tick.value - view.bottom_mm) * px_per_mm);
    sheet.line(foot, foot - Pixel(6.0, 0.0), kFrame);
    sheet.text(foot - Pixel(10.0, 0.0), tick.label,
               {.size_px = 17.0, .horizontal = Horizontal::Right});
  }
  sheet.text({map.centre().x(), map.bottom - 48.0}, own_axes ? "x [mm]" : "u [mm]",
             {.size_px = 17.0, .horizontal = Horizontal::Centre});
  sheet.text({map.left - 52.0, map.centre().y()}, own_axes ? "y [mm]" : "v [mm]",
             {.size_px = 17.0,
              .horizontal = Horizontal::Centre,
              .vertical = Vertical::Centre,
              .turned_deg = 90.0});
}

// The largest of 1, 2, 5 times a power of ten that takes at most 30 % of the map.
double scale_bar_mm(const View& view) {
  const double most = 0.3 * view.width_mm;
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= most) return factor * power;
  }
  return power;
}

void draw_scale_bar(Sheet& sheet, const View& view, const Box& map) {
  const double length_mm = scale_bar_mm(view);
  const double length_px = length_mm * map.width / view.width_mm;
  const Pixel left(map.left, map.bottom - 22.0);
  sheet.line(left, left + Pixel(length_px, 0.0), {.width_px = 4.0});
  sheet.text(left + Pixel(length_px + 10.0, 0.0), short_number(length_mm, 3) + " mm",
             {.size_px = 17.0});
}

/// Less than a thousandth of a square micrometre is rounding.
std::string short_area(double mm2) { return short_number(mm2 < 1e-9 ? 0.0 : mm2, 2); }

void draw_ruler(Sheet& sheet, const View& view, const Box& map) {
  if (view.flat) {
    draw_axes(sheet, view, map);
  } else {
    draw_scale_bar(sheet, view, map);
  }
}

void draw_bar(Sheet& sheet, const Box& map, const ColourScale& scale, const std::string& unit,
              std::optional<double> mark) {
  const double height = std::min(map.height, 460.0);
  const Box bar{map.right() + 18.0, map.bottom + (map.height - height) / 2.0, 20.0, height};
  const int steps = static_cast<int>(bar.height);
  const auto place = [&](double value) {
    return bar.bottom + bar.height * (value - scale.lowest) / (scale.highest - scale.lowest);
  };
  for (int i = 0; i < steps; ++i) {
    const double value = scale.lowest + (scale.highest - scale.lowest) * (i + 0.5) / steps;
    sheet.fill(Box{bar.left, bar.bottom + i, bar.width, std::min(1.5, bar.height - i)},
               scale.at(value));
  }
  sheet.frame(bar, kFrame);
  for (const Tick& tick : ticks(scale.lowest, scale.highest, tick_count(bar.height))) {
    const Pixel foot(bar.right(), place(tick.value));
    sheet.line(foot, foot + Pixel(5.0, 0.0), kFrame);
    sheet.text(foot + Pixel(9.0, 0.0), tick.label, {.size_px = 16.0});
  }
  if (mark && *mark > scale.lowest && *mark < scale.highest) {
    sheet.line({bar.left, place(*mark)}, {bar.right(), place(*mark)},
               {.width_px = 3.0, .colour = {0, 0, 0}});
  }
  if (!unit.empty()) {
    sheet.text({map.right() + kRightOfMap_px - 14.0, bar.centre().y()}, unit,
               {.size_px = 16.0,
                .colour = kGrey,
                .horizontal = Horizontal::Centre,
                .vertical = Vertical::Centre,
                .turned_deg = 90.0});
  }
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

void draw_mean(Sheet& sheet, const Outcome& outcome, const Plan& plan, const Box& map,
               const std::string& letter, bool with_touches) {
  vtkDataArray* detrended =
      outcome.field("mean_detrended");  // what the level cuts, where there is a trend
  vtkDataArray& mean = detrended != nullptr ? *detrended : *outcome.field("mean");
  const ColourScale scale = scale_of_mean(mean, plan.level);
  TissueScene scene(sheet.scene(map), plan.view, map);
  scene.paint_field(outcome, mean, scale);
  if (with_touches) scene.draw_touches(outcome.touches, plan.touch_radius_px);
  draw_boundaries(scene, outcome, /*with_truth=*/true);
  scene.finish();
  draw_title(sheet, map, letter,
             with_touches ? "Believed stiffness"
             : plan.level ? "Boundary"
                          : "Nothing found");
  draw_ruler(sheet, plan.view, map);
  draw_bar(sheet, map, scale, unit_of(outcome), plan.level);
}

void draw_uncertainty(Sheet& sheet, const Outcome& outcome, const Plan& plan, const Box& map) {
  const bool has_stddev = outcome.field("stddev") != nullptr;
  vtkDataArray* field = has_stddev ? outcome.field("stddev") : outcome.field("acquisition");
  if (field == nullptr) {
    draw_mean(sheet, outcome, plan, map, "b", /*with_touches=*/false);
    return;
  }
  const ColourScale scale = scale_of_uncertainty(*field, has_stddev);
  TissueScene scene(sheet.scene(map), plan.view, map);
  scene.paint_field(outcome, *field, scale);
  scene.draw_border(kRim);
  scene.draw_touches(outcome.touches, plan.touch_radius_px);
  scene.finish();
  draw_title(sheet, map, "b", has_stddev ? "Standard deviation" : "Acquisition");
  draw_ruler(sheet, plan.view, map);
  draw_bar(sheet, map, scale, has_stddev ? unit_of(outcome) : "", std::nullopt);
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

void draw_margins(Sheet& sheet, const Outcome& outcome, const Plan& plan, const Box& map) {
  TissueScene scene(sheet.scene(map), plan.view, map);
  scene.paint_margins(outcome, *plan.level, *plan.truth_level);
  scene.draw_border(kRim);
  scene.draw_curves(outcome, "estimate", kMarginLine);
  scene.finish();
  draw_title(sheet, map, "c", "Margins");
  draw_ruler(sheet, plan.view, map);
  draw_margin_keys(sheet, outcome, map);
}

void draw_zone_keys(Sheet& sheet, const BandNumbers& band, const Box& map) {
  const Pixel first(map.right() + 14.0, map.centre().y() + 92.0);
  const Pixel down(0.0, -62.0);
  draw_patch_key(sheet, first, kSurelyTumour, "sure", band.inner_area_mm2);
  draw_patch_key(sheet, first + down, kUnsure, "unsure", std::nullopt);
  if (band.half_width_mm)
    sheet.text(first + down + Pixel(0.0, -22.0),
               kPlusMinus + short_number(*band.half_width_mm, 2) + " mm",
               {.size_px = 16.0, .colour = kGrey});
  draw_patch_key(sheet, first + 2.0 * down, kHealthy, "healthy", std::nullopt);
}

/// Where to cut: what is tumour as good as surely, what is healthy as good as surely, and the band
/// between.
void draw_band(Sheet& sheet, const Outcome& outcome, const Plan& plan, const Box& map) {
  const BandNumbers& band = *outcome.summary.band;
  TissueScene scene(sheet.scene(map), plan.close_up, map);
  scene.paint_zones(outcome, *band.score);
  scene.draw_border(kRim);
  scene.draw_curves(outcome, "estimate", kMarginLine);
  scene.draw_curves(outcome, "cut", kCutHalo);
  scene.draw_curves(outcome, "cut", kCutLine);
  scene.draw_curves(outcome, "truth", kTruthLine);
  scene.finish();
  draw_title(sheet, map, "c",
             band.probability
                 ? "Where it ends, " + short_number(100.0 * *band.probability, 3) + " % sure"
                 : "Where it ends");
  draw_ruler(sheet, plan.close_up, map);
  if (plan.close_up.width_mm < plan.view.width_mm) sheet.frame(map, kFrame);
  draw_zone_keys(sheet, band, map);
}

void draw_probability(Sheet& sheet, const Outcome& outcome, const Plan& plan, const Box& map) {
  const ColourScale scale{Palette::WhitePurple, 0.0, 1.0};
  TissueScene scene(sheet.scene(map), plan.view, map);
  scene.paint_field(outcome, *outcome.field("probability_inside"), scale);
  draw_boundaries(scene, outcome, /*with_truth=*/true);
  scene.finish();
  draw_title(sheet, map, "c", "Probability of tumour");
  draw_ruler(sheet, plan.view, map);
  draw_bar(sheet, map, scale, "", std::nullopt);
}

void draw_third(Sheet& sheet, const Outcome& outcome, const Plan& plan, const Box& map) {
  switch (plan.third) {
    case Third::Band:
      return draw_band(sheet, outcome, plan, plan.layout.close_up);
    case Third::Margins:
      return draw_margins(sheet, outcome, plan, map);
    case Third::Probability:
      return draw_probability(sheet, outcome, plan, map);
    case Third::Mean:
      return draw_mean(sheet, outcome, plan, map, "c", /*with_touches=*/false);
  }
}

std::string touches_text(const Outcome& outcome) {
  const double count =
      outcome.summary.measurements.value_or(static_cast<double>(outcome.touches.size()));
  return short_number(count, 7) + (count == 1.0 ? " touch" : " touches");
}

std::string error_text(const ErrorNumbers& error) {
  std::string text;
  if (error.symmetric_difference_mm2)
    text += "Error " + short_number(*error.symmetric_difference_mm2, 3) + kSquareMm;
  if (error.missed_mm2 && error.extra_mm2 && !text.empty())
    text += ", " + short_area(*error.missed_mm2) + " missed and " + short_area(*error.extra_mm2) +
            " extra";
  if (error.percent_of_search_area && !text.empty())
    text += " (" + short_number(*error.percent_of_search_area, 2) + " % of the search area)";
  if (error.dice && text.empty()) text += "Dice " + short_number(*error.dice, 3);
  return text;
}

std::string caption_of(const Outcome& outcome) {
  constexpr const char* kBetween = "   \u00b7   ";
  const Summary& summary = outcome.summary;
  std::string caption = touches_text(outcome);
  if (summary.nothing_wider_than_mm)
    return caption + kBetween + "nothing found" + kBetween + "no tumour wider than " +
           short_number(*summary.nothing_wider_than_mm, 3) + " mm";
  if (summary.error) {
    const std::string error = error_text(*summary.error);
    if (!error.empty()) caption += kBetween + error;
  } else if (summary.expected_error_mm2) {
    caption += std::string(kBetween) + "expected error " +
               short_number(*summary.expected_error_mm2, 3) + kSquareMm;
  }
  if (summary.error && summary.expected_error_mm2)
    caption += std::string(kBetween) + "expected " + short_number(*summary.expected_error_mm2, 3) +
               kSquareMm;
  if (summary.area_mm2)
    caption += std::string(kBetween) + "tumour " + short_number(*summary.area_mm2, 4) + kSquareMm;
  if (summary.level) caption += std::string(kBetween) + "level " + short_number(*summary.level, 4);
  return caption;
}

}  // namespace

std::string picture_of(const Outcome& outcome) {
  if (outcome.field("mean") == nullptr)
    throw IoError("surface.vtp: no field named mean at the points");
  const Plan plan = plan_of(outcome);
  const Layout& layout = plan.layout;
  Sheet sheet(layout.width_px, layout.height_px);
  draw_mean(sheet, outcome, plan, layout.maps[0], "a", /*with_touches=*/true);
  draw_uncertainty(sheet, outcome, plan, layout.maps[1]);
  draw_third(sheet, outcome, plan, layout.maps[2]);
  draw_legend(sheet, layout.legend, kCaption_px);
  const std::string caption = caption_of(outcome);
  TextStyle style{.size_px = 21.0, .bold = true, .horizontal = Horizontal::Centre};
  const double room_px = sheet.width_px() - 2.0 * kCaptionMargin_px;
  style.size_px *= std::min(1.0, room_px / text_width_px(caption, style));
  sheet.text({sheet.width_px() / 2.0, kCaption_px / 2.0 + 2.0}, caption, style);
  return sheet.png();
}

}  // namespace palpation::draw
