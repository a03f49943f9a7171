/// Lengths on the tissue of what is drawn in its chart. Private to this folder.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

/// A chart that stretches the tissue, face by face. Beside the chart a metre is a metre.
class TissueRuler {
 public:
  explicit TissueRuler(const Surface& surface);

  /// Length on the tissue of the straight line in the chart: exact for the mesh.
  double length(const Vec2& from, const Vec2& to) const;

  /// How a small step in the chart at a place runs on the tissue: its length there is |matrix *
  /// step|.
  Eigen::Matrix2d stretch_at(const Vec2& place) const;

 private:
  struct Face {
    std::array<Vec2, 3> corners;
    Eigen::Matrix2d to_tissue;
  };
  struct Bins {
    int first_column, last_column, first_row, last_row;
  };
  Bins bins_of(const Vec2& low, const Vec2& high) const;
  template <typename What>
  void for_each_bin(const What& what) const;

  std::vector<Face> faces_;
  Vec2 lower_;
  double bin_m_ = 0.0;
  int columns_ = 0, rows_ = 0;
  std::vector<int> first_,
      numbers_;  ///< bin i has the faces numbers_[first_[i]] to numbers_[first_[i + 1] - 1]
};

}  // namespace palpation
