/// The order in which a belief stores the vertices: tiles of eight that lie together, so that what
/// is near is looked at together.
#pragma once

#include <memory>
#include <vector>

#include "base/tile.h"
#include "palpation/belief/prior.h"

namespace palpation {

/// Places are numbered tile * kLanes + lane. In the intrinsic metric they are the vertices
/// themselves, as the spectrum has them; in the others they follow the surface's locality order.
/// The last tile is filled up with its last vertex, again and again.
class VertexTiles {
 public:
  explicit VertexTiles(const Prior& prior);

  int count() const { return static_cast<int>(vertex_.size()) / kLanes; }
  int vertex_count() const { return static_cast<int>(place_.size()); }
  /// How many of a tile's lanes are vertices of its own.
  int lanes(int tile) const { return tile + 1 < count() ? kLanes : vertex_count() - tile * kLanes; }
  const int* vertices(int tile) const { return vertex_.data() + static_cast<long>(tile) * kLanes; }
  int place(int vertex) const { return place_[vertex]; }
  /// Eight x, eight y, eight z in the metric.
  const double* coordinates(int tile) const {
    return coordinates_.data() + static_cast<long>(tile) * 3 * kLanes;
  }

 private:
  std::vector<int> vertex_;  // in whole tiles
  std::vector<int> place_;
  std::vector<double> coordinates_;  // empty in the intrinsic metric
};

}  // namespace palpation
