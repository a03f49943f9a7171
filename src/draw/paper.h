/// Places, boxes and words on a sheet of paper, in pixels from its lower left corner.
#pragma once

#include <Eigen/Core>

#include "draw/colour.h"

namespace palpation::draw {

using Pixel = Eigen::Vector2d;

struct Box {
  double left = 0.0;
  double bottom = 0.0;
  double width = 0.0;
  double height = 0.0;
  double right() const { return left + width; }
  double top() const { return bottom + height; }
  Pixel centre() const { return {left + width / 2.0, bottom + height / 2.0}; }
};

enum class Horizontal { Left, Centre, Right };
enum class Vertical { Bottom, Centre, Top };

struct TextStyle {
  double size_px = 19.0;
  bool bold = false;
  Colour colour = kInk;
  Horizontal horizontal = Horizontal::Left;
  Vertical vertical = Vertical::Centre;
  double turned_deg = 0.0;
};

}  // namespace palpation::draw
