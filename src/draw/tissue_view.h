/// Tissue as a picture shows it: turned towards the viewer, in millimetres, with lines and dots
/// that face the viewer too.
///
/// Planar tissue is seen from straight above with its chart's axes (u to the right, v upwards).
/// Curved tissue is seen along the mean outward normal of the tumour, or of the whole where there
/// is none, with the mesh's x axis to the right as far as that is possible.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "draw/outcome.h"
#include "draw/sheet.h"

class vtkRenderer;

namespace palpation::draw {

struct View {
  Eigen::Matrix3d turn =
      Eigen::Matrix3d::Identity();  ///< rows: to the right, upwards, towards the viewer
  Vec3 origin = Vec3::Zero();       ///< metres
  bool flat = true;
  bool in_chart = false;  ///< of tissue laid flat
  double left_mm = 0.0, bottom_mm = 0.0, width_mm = 0.0,
         height_mm = 0.0;                   ///< what is visible, with a small margin
  double front_mm = 0.0, back_mm = 0.0;     ///< depth of the tissue along the line of sight
  std::vector<std::array<Vec3, 2>> rim_mm;  ///< the border of the tissue, side by side, in the view

  Vec3 to_view_mm(const Vec3& position_m) const { return turn * (position_m - origin) * 1e3; }
};

View view_of(const Outcome& outcome, std::optional<double> level);

/// The part of a view of flat tissue that holds the curves of these kinds, with some room; the
/// whole view where there are none.
View zoomed_to(const View& whole, const Outcome& outcome, const std::vector<std::string>& kinds);

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

  vtkRenderer& renderer_;
  View view_;
  double mm_per_px_ = 1.0;
  int layers_ = 0;
};

/// How a touch is drawn: ring (initial) or dot; small on the way; amber if set aside. Shared by
/// maps and legends.
struct TouchLook {
  double radius_px;
  Colour rim, core;
  double core_share;  ///< radius of the core / radius
};
TouchLook look_of(const Touch& touch, double radius_px);

}  // namespace palpation::draw
