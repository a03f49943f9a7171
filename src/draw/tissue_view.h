/// Tissue as a picture shows it: painted, in a view, with lines and dots that face the viewer.
#pragma once

#include <string>
#include <vector>

#include "draw/outcome.h"
#include "draw/sheet.h"
#include "draw/view.h"

class vtkRenderer;

namespace palpation::draw {

/// One panel's scene. Coordinates are the view's; sizes of lines and dots are pixels of the sheet.
/// Later lines and dots lie above earlier ones.
class TissueScene {
 public:
  TissueScene(vtkRenderer& renderer, const View& view, const Box& box);

  void paint_field(const Outcome& outcome, vtkDataArray& field, const ColourScale& scale);
  /// Four colours: where neither, only the estimate, only the truth, or both reach their levels.
  void paint_margins(const Outcome& outcome, double estimate_level, double truth_level);
  /// Three colours: where the score is above the band, in it, and below.
  void paint_zones(const Outcome& outcome, double band_score);
  /// A grey veil with hatching where no reading that counts is near.
  void draw_not_searched(const Outcome& outcome);
  void draw_curves(const Outcome& outcome, const std::string& kind, const LineStyle& style);
  /// The rim of the tissue.
  void draw_border(const LineStyle& style);
  void draw_touches(const std::vector<Touch>& touches, double radius_px);

  /// Points the camera; to be called last.
  void finish();

 private:
  double lift_next_layer();
  void paint(vtkPolyData& part, Colour colour);
  void add_unlit(vtkPolyData& shapes, Colour colour);
  void add_veil(vtkPolyData& part);

  vtkRenderer& renderer_;
  View view_;
  double mm_per_px_ = 1.0;
  int layers_ = 0;
};

/// How a touch is drawn: ring (initial) or dot; small on the way; amber if set aside; magenta if
/// it is the next to be made. Shared by
/// maps and legends.
struct TouchLook {
  double radius_px;
  Colour rim, core;
  double core_share;  ///< radius of the core / radius
};
TouchLook look_of(const Touch& touch, double radius_px);

}  // namespace palpation::draw
