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
#include "draw/vector_page.h"

class vtkRenderer;

namespace palpation::draw {

struct LineStyle {
  double width_px = 1.0;
  Colour colour = kInk;
  double dash_px = 0.0;  ///< length of a dash and of a gap; 0 for a line without gaps
};

class Sheet {
 public:
  /// Its pixels are units to place things by; drawn it has `scale` times as many. Throws
  /// NoGraphics.
  Sheet(int width_px, int height_px, double scale = 1.0);
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
  /// What was drawn as shapes and words, and the scenes as images. Throws NoGraphics.
  VectorPage page();

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
