#include "draw/layout.h"

#include <algorithm>
#include <cmath>

namespace palpation::draw {
namespace {

constexpr double kEdge_px = 24.0;   // around everything
constexpr double kTitle_px = 50.0;  // above a map
constexpr double kAboveLegend_px = 14.0;
constexpr double kMapHeight_px = 690.0;  // the most a map may take beside others
constexpr int kStackedWidth_px = 1300;
constexpr double kStackedMapHeight_px = 340.0;
constexpr double kStackedAspect =
    1.9;  // tissue wider than this times its height: maps one above the other

double left_of_map_px(const View& view) { return view.flat ? 62.0 : 12.0; }

double below_map_px(const View& view) { return view.flat ? 64.0 : 44.0; }

// The largest map that fits, centred between left and right and standing on the bottom.
Box fitted(const View& view, double left, double width, double bottom, double height) {
  const double scale = std::min(width / view.width_mm, height / view.height_mm);
  const double map_width = std::max(1.0, std::floor(scale * view.width_mm));
  const double map_height = std::max(1.0, std::floor(map_width * view.height_mm / view.width_mm));
  return {std::floor(left + (width - map_width) / 2.0), bottom, map_width, map_height};
}

/// At half the height of a map beside it.
Box beside(const Box& map, Box box) {
  box.bottom = std::floor(map.bottom + (map.height - box.height) / 2.0);
  return box;
}

double below_lowest_map_px(const Layout& layout, const View& view) {
  return kCaption_px + kLegendRow_px * static_cast<double>(layout.legend.size()) + kAboveLegend_px +
         below_map_px(view);
}

void put_side_by_side(Layout& layout, const View& view, const View& close_up) {
  const double left = left_of_map_px(view);
  const double cell = (layout.width_px - 2.0 * kEdge_px) / 3.0;
  for (int i = 0; i < 3; ++i) {
    layout.maps[static_cast<std::size_t>(i)] =
        fitted(view, kEdge_px + i * cell + left, cell - left - kRightOfMap_px,
               below_lowest_map_px(layout, view), kMapHeight_px);
  }
  const Box& last = layout.maps[2];
  layout.close_up = beside(last, fitted(close_up, kEdge_px + 2.0 * cell + left,
                                        cell - left - kRightOfMap_px, last.bottom, last.height));
}

void put_one_above_the_other(Layout& layout, const View& view, const View& close_up) {
  const double left = left_of_map_px(view);
  double bottom = below_lowest_map_px(layout, view);
  for (std::size_t i : {2u, 1u, 0u}) {
    layout.maps[i] =
        fitted(view, kEdge_px + left, layout.width_px - 2.0 * kEdge_px - left - kRightOfMap_px,
               bottom, kStackedMapHeight_px);
    bottom = layout.maps[i].top() + kTitle_px + below_map_px(view);
  }
  const Box& last = layout.maps[2];
  layout.close_up =
      fitted(close_up, kEdge_px + left, layout.width_px - 2.0 * kEdge_px - left - kRightOfMap_px,
             last.bottom, last.height);
}

}  // namespace

Layout layout_of(const Outcome& outcome, const View& view, const View& close_up) {
  Layout layout;
  const bool stacked = view.width_mm > kStackedAspect * view.height_mm;
  if (stacked) layout.width_px = kStackedWidth_px;
  layout.legend = legend_rows(outcome, layout.width_px - 2.0 * kEdge_px);
  if (stacked) {
    put_one_above_the_other(layout, view, close_up);
  } else {
    put_side_by_side(layout, view, close_up);
  }
  layout.height_px = static_cast<int>(std::ceil(layout.maps[0].top() + kTitle_px + 8.0));
  return layout;
}

}  // namespace palpation::draw
