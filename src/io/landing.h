/// Positions from files taken to the surface they are meant to be on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

class Landing {
 public:
  /// Keeps a reference: the surface must outlive it.
  explicit Landing(const Surface& surface, double farthest_beside_m = 0.001);

  /// The closest point of the surface; or nothing, and what is wrong, for a position more than 5 mm
  /// off the surface or too far beside its border.
  std::optional<SurfacePoint> place(const Vec3& position, std::string& fault);

  int moved() const { return moved_; }  ///< how many positions lay more than 0.1 mm off
  double farthest_m() const { return farthest_m_; }

 private:
  double beside_m(const Vec3& position, const SurfacePoint& closest) const;
  bool is_on_border(const SurfacePoint& point) const;

  const Surface& surface_;
  double farthest_beside_m_;
  Vec3 least_, most_;
  std::vector<bool> on_border_;  // by vertex
  int moved_ = 0;
  double farthest_m_ = 0.0;
};

}  // namespace palpation
