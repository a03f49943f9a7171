/// A sheet of paper: lines, shapes and text in pixels, y upwards from the lower left corner, and
/// windows through which a scene is seen.
///
/// What is drawn later lies above what was drawn earlier; everything drawn lies above the scenes.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "draw/colour.h"

class vtkRenderer;

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

struct LineStyle {
  double width_px = 1.0;
  Colour colour = kInk;
  double dash_px = 0.0;  ///< length of a dash and of a gap; 0 for a line without gaps
};

class Sheet {
 public:
  /// Throws NoGraphics.
  Sheet(int width_px, int height_px);
  ~Sheet();
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;

  int width_px() const;
  int height_px() const;

  void line(const Pixel& from, const Pixel& to, const LineStyle& style);
  void polyline(const std::vector<Pixel>& points, const LineStyle& style);
  void fill(const Box& box, Colour colour);
  void frame(const Box& box, const LineStyle& style);
  /// Corners of a convex polygon.
  void fill(const std::vector<Pixel>& convex_polygon, Colour colour);
  void disc(const Pixel& centre, double radius_px, Colour colour);
  void text(const Pixel& place, const std::string& words, const TextStyle& style);

  /// A window in the sheet onto a scene of its own; the caller sets its camera. White where the
  /// scene has nothing.
  vtkRenderer& scene(const Box& box);

  /// The bytes of a PNG file. Throws NoGraphics.
  std::string png();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// How wide a text will be.
double text_width_px(const std::string& words, const TextStyle& style);

/// Cuts a line into dashes of equal length with gaps of the same length; the whole line if dash <=
/// 0.
std::vector<std::vector<Eigen::Vector3d>> dashes(const std::vector<Eigen::Vector3d>& line,
                                                 double dash);

/// The corners of a regular polygon that looks like a circle of this radius.
std::vector<Pixel> circle(const Pixel& centre, double radius_px);

}  // namespace palpation::draw
