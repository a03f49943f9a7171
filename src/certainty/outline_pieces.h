/// An outline's pieces in columns, so that many of them are measured at once.
#pragma once

#include <vector>

#include "certainty/outline_nodes.h"

namespace palpation {

class OutlinePieces {
 public:
  explicit OutlinePieces(const OutlineNodes& outline);

  /// Puts a piece elsewhere.
  void set(int piece, const Vec2& from, const Vec2& to);

  /// As nearest_piece and is_inside of outline_nodes.h, but for rounding.
  NearestPiece nearest(const Vec2& place) const;
  bool encloses(const Vec2& place) const;
  /// As depth_in there.
  double depth_at(const Vec2& place) const;

 private:
  std::vector<double> from_x_, from_y_, to_y_, along_x_, along_y_;
  std::vector<double> inverse_square_;  // of the length; 0 of a piece that has none
};

}  // namespace palpation
