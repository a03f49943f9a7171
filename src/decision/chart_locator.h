/// Which part of the tissue lies at a place of its chart.
#pragma once

#include <optional>
#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

/// Faces sorted into square bins of the chart, so that a look-up sees a handful of them.
class ChartLocator {
 public:
  /// Throws InvalidInput as Surface::chart.
  explicit ChartLocator(const Surface& surface);

  /// Corners of the chart's bounding box.
  const Vec2& lower() const { return lower_; }
  const Vec2& upper() const { return upper_; }

  /// Where a point of the tissue lies in the chart.
  Vec2 place(const SurfacePoint& point) const;

  /// The point of the lowest face that contains the place, rounding forgiven; nothing off the
  /// tissue.
  std::optional<SurfacePoint> at(const Vec2& place) const;

 private:
  struct Bins {
    int first_column, last_column, first_row, last_row;
  };
  int bin_along(double offset, int count) const;
  Bins bins_of(int face) const;
  double entries() const;
  void fill();

  Surface surface_;
  const Points2& uv_;  // owned by what all copies of the surface share
  Vec2 lower_, upper_;
  double bin_m_ = 0.0;
  int columns_ = 1, rows_ = 1;
  std::vector<int> first_;  // of each bin in faces_, and the end
  std::vector<int> faces_;
};

}  // namespace palpation
