#include "draw/ruler.h"

#include <algorithm>
#include <cmath>

#include "draw/axis.h"
#include "draw/layout.h"
#include "draw/look.h"

namespace palpation::draw {
namespace {

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

}  // namespace

void draw_ruler(Sheet& sheet, const View& view, const Box& map) {
  if (view.flat) {
    draw_axes(sheet, view, map);
  } else {
    draw_scale_bar(sheet, view, map);
  }
}

void draw_colour_bar(Sheet& sheet, const Box& map, const ColourScale& scale,
                     const std::string& unit, std::optional<double> mark) {
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

}  // namespace palpation::draw
