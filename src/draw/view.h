/// From where tissue is seen: turned towards the viewer, in millimetres.
///
/// Planar tissue is seen from straight above with its chart's axes (u to the right, v upwards).
/// Curved tissue is seen along the mean outward normal of the tumour, or of the whole where there
/// is none, with the mesh's x axis to the right as far as that is possible.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "draw/outcome.h"

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

}  // namespace palpation::draw
