#include "draw/stop_numbers.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

namespace palpation::draw {
namespace {

constexpr double kGap_px = 1.5;   // between a dot and its number
constexpr double kPad_px = 2.0;   // around a number
constexpr double kOutside = 4.0;  // how much worse than hiding something it is to leave the map

/// Where a box may lie, from its dot: right, left, above, below, and the corners.
constexpr std::array<std::array<int, 2>, 8> kSides = {
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};

double overlap_px2(const Box& a, const Box& b) {
  const double width = std::min(a.right(), b.right()) - std::max(a.left, b.left);
  const double height = std::min(a.top(), b.top()) - std::max(a.bottom, b.bottom);
  return std::max(0.0, width) * std::max(0.0, height);
}

Box around(const Pixel& centre, const Pixel& size) {
  return {centre.x() - size.x() / 2.0, centre.y() - size.y() / 2.0, size.x(), size.y()};
}

/// In square pixels: what a box there would hide, and what of it would lie outside.
double cost_of(const Box& box, const std::vector<Box>& hidden, const Box& map) {
  double cost = kOutside * (box.width * box.height - overlap_px2(box, map));
  for (const Box& other : hidden) cost += overlap_px2(box, other);
  return cost;
}

Box best_beside(const Pixel& dot, const Pixel& size, double radius_px,
                const std::vector<Box>& hidden, const Box& map) {
  Box best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [x, y] : kSides) {
    const double slant = x != 0 && y != 0 ? 0.7 : 1.0;  // the dot is round
    const Pixel reach = slant * Pixel::Constant(radius_px + kGap_px) + size / 2.0;
    const Box box = around(dot + Pixel(x * reach.x(), y * reach.y()), size);
    const double cost = cost_of(box, hidden, map);
    if (cost >= least) continue;
    least = cost;
    best = box;
  }
  return best;
}

}  // namespace

std::vector<Box> boxes_beside(const std::vector<Pixel>& dots, const std::vector<Pixel>& sizes,
                              const std::vector<Pixel>& others, double radius_px, const Box& map) {
  std::vector<Box> hidden;
  for (const Pixel& dot : others) hidden.push_back(around(dot, Pixel::Constant(2.0 * radius_px)));
  for (const Pixel& dot : dots) hidden.push_back(around(dot, Pixel::Constant(2.0 * radius_px)));
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < dots.size(); ++i) {
    boxes.push_back(best_beside(dots[i], sizes[i], radius_px, hidden, map));
    hidden.push_back(boxes.back());
  }
  return boxes;
}

void draw_stop_numbers(Sheet& sheet, const std::vector<Touch>& touches, const View& view,
                       const Box& map, double radius_px) {
  const TextStyle style{.size_px = std::clamp(2.6 * radius_px, 9.0, 14.0),
                        .bold = true,
                        .horizontal = Horizontal::Centre};
  std::vector<Pixel> dots, sizes, others;
  std::vector<std::string> words;
  for (const Touch& touch : touches) {
    const Vec3 place = view.to_view_mm(touch.position);
    (touch.planned ? dots : others)
        .emplace_back(map.left + (place.x() - view.left_mm) / view.width_mm * map.width,
                      map.bottom + (place.y() - view.bottom_mm) / view.height_mm * map.height);
    if (!touch.planned) continue;
    words.push_back(std::to_string(touch.index));
    sizes.emplace_back(text_width_px(words.back(), style) + 2.0 * kPad_px, style.size_px + kPad_px);
  }
  const std::vector<Box> boxes = boxes_beside(dots, sizes, others, radius_px, map);
  for (const Box& box : boxes) sheet.fill(box, kWhite);
  for (std::size_t i = 0; i < boxes.size(); ++i) sheet.text(boxes[i].centre(), words[i], style);
}

}  // namespace palpation::draw
