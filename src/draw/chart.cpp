#include "draw/chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "draw/axis.h"
#include "draw/sheet.h"
#include "palpation/base/error.h"

namespace palpation::draw {
namespace {

constexpr LineStyle kFrame{.width_px = 1.4, .colour = kGrey};
constexpr LineStyle kGrid{.width_px = 1.0, .colour = {228, 229, 232}};
constexpr LineStyle kFineGrid{.width_px = 1.0, .colour = {241, 242, 244}};

struct Range {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
  bool empty() const { return lowest > highest; }
  void include(double value) {
    if (!std::isfinite(value)) return;
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
};

double error_at(const ChartCurve& curve, std::size_t i) {
  return i < curve.se.size() && std::isfinite(curve.se[i]) ? std::abs(curve.se[i]) : 0.0;
}

bool can_be_drawn(const Chart& chart, const ChartCurve& curve, std::size_t i) {
  return std::isfinite(chart.x[i]) && std::isfinite(curve.y[i]) &&
         (!chart.logarithmic_y || curve.y[i] > 0.0);
}

Range range_of_y(const Chart& chart) {
  Range range;
  for (const ChartCurve& curve : chart.curves) {
    for (std::size_t i = 0; i < chart.x.size(); ++i) {
      if (!can_be_drawn(chart, curve, i)) continue;
      const double error = chart.spread == Spread::None ? 0.0 : error_at(curve, i);
      range.include(curve.y[i] + error);
      const double low = curve.y[i] - error;
      range.include(chart.logarithmic_y && low <= 0.0 ? curve.y[i] : low);
    }
  }
  return range;
}

Range range_of_x(const Chart& chart) {
  Range range;
  for (const double x : chart.x) range.include(x);
  return range;
}

void widen_if_constant(Range& range) {
  if (range.highest > range.lowest) return;
  const double half = range.lowest == 0.0 ? 1.0 : 0.05 * std::abs(range.lowest);
  range = {range.lowest - half, range.highest + half};
}

// Linear axes start at zero where that wastes at most half of the height: a curve that falls is
// then seen at its true proportion.
void add_room(Range& range, bool logarithmic) {
  if (logarithmic) {
    const double factor = std::pow(range.highest / range.lowest, 0.06);
    range = {range.lowest / std::max(factor, 1.05), range.highest * std::max(factor, 1.05)};
    return;
  }
  widen_if_constant(range);
  const double room = 0.06 * (range.highest - range.lowest);
  const bool from_zero = range.lowest >= 0.0 && range.lowest <= 0.5 * range.highest;
  range = {from_zero ? 0.0 : range.lowest - room, range.highest + room};
}

// The plane of a chart: values to pixels, cut off at the frame.
class Plane {
 public:
  Plane(const Chart& chart, const Box& box)
      : box_(box), logarithmic_(chart.logarithmic_y), x_(range_of_x(chart)), y_(range_of_y(chart)) {
    require(!x_.empty() && !y_.empty(), "chart", "the table", "holds nothing that can be drawn");
    widen_if_constant(x_);
    const double room = 0.03 * (x_.highest - x_.lowest);
    x_ = {x_.lowest - room, x_.highest + room};
    add_room(y_, logarithmic_);
  }
  const Box& box() const { return box_; }
  std::vector<Tick> x_ticks() const { return ticks(x_.lowest, x_.highest, 9); }
  std::vector<Tick> y_ticks() const {
    return logarithmic_ ? logarithmic_ticks(y_.lowest, y_.highest)
                        : ticks(y_.lowest, y_.highest, 7);
  }
  double across(double x) const {
    return box_.left + box_.width * (x - x_.lowest) / (x_.highest - x_.lowest);
  }
  double up(double y) const {
    return box_.bottom + box_.height * std::clamp(share_of(y), 0.0, 1.0);
  }
  Pixel at(double x, double y) const { return {across(x), up(y)}; }

 private:
  double share_of(double y) const {
    if (!logarithmic_) return (y - y_.lowest) / (y_.highest - y_.lowest);
    return y > 0.0 ? std::log(y / y_.lowest) / std::log(y_.highest / y_.lowest) : 0.0;
  }

  Box box_;
  bool logarithmic_;
  Range x_, y_;
};

double widest_label_px(const std::vector<Tick>& all) {
  double widest = 0.0;
  for (const Tick& tick : all) widest = std::max(widest, text_width_px(tick.label, {}));
  return widest;
}

void draw_axes(Sheet& sheet, const Chart& chart, const Plane& plane) {
  const Box& box = plane.box();
  for (const Tick& tick : plane.x_ticks()) {
    const double x = plane.across(tick.value);
    sheet.line({x, box.bottom}, {x, box.top()}, kGrid);
    sheet.line({x, box.bottom}, {x, box.bottom - 6.0}, kFrame);
    sheet.text({x, box.bottom - 11.0}, tick.label,
               {.horizontal = Horizontal::Centre, .vertical = Vertical::Top});
  }
  for (const Tick& tick : plane.y_ticks()) {
    const double y = plane.up(tick.value);
    sheet.line({box.left, y}, {box.right(), y}, tick.label.empty() ? kFineGrid : kGrid);
    sheet.line({box.left, y}, {box.left - (tick.label.empty() ? 3.0 : 6.0), y}, kFrame);
    sheet.text({box.left - 11.0, y}, tick.label, {.horizontal = Horizontal::Right});
  }
  sheet.frame(box, kFrame);
  sheet.text({box.centre().x(), box.bottom - 56.0}, chart.x_label,
             {.size_px = 21.0, .horizontal = Horizontal::Centre});
  sheet.text({box.left - widest_label_px(plane.y_ticks()) - 36.0, box.centre().y()}, chart.y_label,
             {.size_px = 21.0, .horizontal = Horizontal::Centre, .turned_deg = 90.0});
  sheet.text({box.left, box.top() + 28.0}, chart.title, {.size_px = 24.0, .bold = true});
}

void draw_band(Sheet& sheet, const Chart& chart, const Plane& plane, const ChartCurve& curve,
               Colour colour) {
  colour.alpha = 48;
  for (std::size_t i = 0; i + 1 < chart.x.size(); ++i) {
    if (!can_be_drawn(chart, curve, i) || !can_be_drawn(chart, curve, i + 1)) continue;
    const auto low = [&](std::size_t k) {
      return plane.at(chart.x[k], curve.y[k] - error_at(curve, k));
    };
    const auto high = [&](std::size_t k) {
      return plane.at(chart.x[k], curve.y[k] + error_at(curve, k));
    };
    sheet.fill(std::vector<Pixel>{low(i), low(i + 1), high(i + 1), high(i)}, colour);
  }
}

void draw_bars(Sheet& sheet, const Chart& chart, const Plane& plane, const ChartCurve& curve,
               Colour colour) {
  const LineStyle style{.width_px = 1.8, .colour = colour};
  for (std::size_t i = 0; i < chart.x.size(); ++i) {
    if (!can_be_drawn(chart, curve, i) || error_at(curve, i) == 0.0) continue;
    const Pixel low = plane.at(chart.x[i], curve.y[i] - error_at(curve, i));
    const Pixel high = plane.at(chart.x[i], curve.y[i] + error_at(curve, i));
    const Pixel serif(5.0, 0.0);
    sheet.line(low, high, style);
    sheet.line(low - serif, low + serif, style);
    sheet.line(high - serif, high + serif, style);
  }
}

// Shapes differ as colours do, so that a print in grey can still be read.
void draw_marker(Sheet& sheet, const Pixel& place, std::size_t index, Colour colour) {
  constexpr double kRadius_px = 5.5;
  const auto corner = [&](double x, double y, double size) {
    return Pixel(place + kRadius_px * size * Pixel(x, y));
  };
  const auto draw = [&](double size, Colour fill) {
    switch (index % 4) {
      case 1:
        return sheet.fill(std::vector<Pixel>{corner(-0.9, -0.9, size), corner(0.9, -0.9, size),
                                             corner(0.9, 0.9, size), corner(-0.9, 0.9, size)},
                          fill);
      case 2:
        return sheet.fill(std::vector<Pixel>{corner(-1.1, -0.75, size), corner(1.1, -0.75, size),
                                             corner(0.0, 1.25, size)},
                          fill);
      case 3:
        return sheet.fill(std::vector<Pixel>{corner(0.0, -1.25, size), corner(1.25, 0.0, size),
                                             corner(0.0, 1.25, size), corner(-1.25, 0.0, size)},
                          fill);
      default:
        return sheet.disc(place, kRadius_px * size, fill);
    }
  };
  draw(1.4, kWhite);
  draw(1.0, colour);
}

void draw_curve(Sheet& sheet, const Chart& chart, const Plane& plane, std::size_t index) {
  const ChartCurve& curve = chart.curves[index];
  const Colour colour = curve_colour(index);
  if (chart.spread == Spread::Bars) draw_bars(sheet, chart, plane, curve, colour);
  std::vector<Pixel> run;
  for (std::size_t i = 0; i <= chart.x.size(); ++i) {
    if (i < chart.x.size() && can_be_drawn(chart, curve, i)) {
      run.push_back(plane.at(chart.x[i], curve.y[i]));
      continue;
    }
    if (run.size() > 1) sheet.polyline(run, {.width_px = 2.8, .colour = colour});
    run.clear();
  }
  constexpr std::size_t kMostMarkers = 60;
  const bool markers = chart.x.size() <= kMostMarkers;
  for (std::size_t i = 0; markers && i < chart.x.size(); ++i) {
    if (can_be_drawn(chart, curve, i))
      draw_marker(sheet, plane.at(chart.x[i], curve.y[i]), index, colour);
  }
}

// Upper right: curves that converge fall away from there.
void draw_legend(Sheet& sheet, const Chart& chart, const Plane& plane) {
  if (chart.curves.size() < 2) return;
  constexpr double kRow_px = 31.0;
  constexpr double kSample_px = 46.0;
  double widest = 0.0;
  for (const ChartCurve& curve : chart.curves)
    widest = std::max(widest, text_width_px(curve.name, {}));
  const double width = widest + kSample_px + 38.0;
  const double height = kRow_px * static_cast<double>(chart.curves.size()) + 14.0;
  const Box box{plane.box().right() - width - 14.0, plane.box().top() - height - 14.0, width,
                height};
  sheet.fill(box, {255, 255, 255, 235});
  sheet.frame(box, {.width_px = 1.0, .colour = kPaleGrey});
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const Pixel place(box.left + 14.0, box.top() - 7.0 - kRow_px * (static_cast<double>(i) + 0.5));
    sheet.line(place, place + Pixel(kSample_px, 0.0), {.width_px = 2.8, .colour = curve_colour(i)});
    draw_marker(sheet, place + Pixel(kSample_px / 2.0, 0.0), i, curve_colour(i));
    sheet.text(place + Pixel(kSample_px + 10.0, 0.0), chart.curves[i].name, {});
  }
}

}  // namespace

std::string picture_of(const Chart& chart) {
  Sheet sheet(chart.width_px, chart.height_px);
  const double top = chart.title.empty() ? 26.0 : 62.0;
  const Box most{110.0, 84.0, chart.width_px - 110.0 - 30.0, chart.height_px - 84.0 - top};
  const double label_px = widest_label_px(Plane(chart, most).y_ticks());
  const double left = label_px + 62.0;
  const Plane plane(chart, {left, most.bottom, chart.width_px - left - 30.0, most.height});
  draw_axes(sheet, chart, plane);
  for (std::size_t i = 0; i < chart.curves.size() && chart.spread == Spread::Band; ++i) {
    draw_band(sheet, chart, plane, chart.curves[i], curve_colour(i));
  }
  for (std::size_t i = 0; i < chart.curves.size(); ++i) draw_curve(sheet, chart, plane, i);
  draw_legend(sheet, chart, plane);
  return sheet.png();
}

}  // namespace palpation::draw
