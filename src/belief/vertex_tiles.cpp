#include "belief/vertex_tiles.h"

#include <algorithm>
#include <numeric>

namespace palpation {

VertexTiles::VertexTiles(const Prior& prior) {
  const Surface& surface = prior.surface();
  const int count = surface.vertex_count(), tiles = (count + kLanes - 1) / kLanes;
  const bool is_intrinsic = prior.metric() == Metric::Intrinsic;
  if (is_intrinsic) {
    vertex_.resize(count);
    std::iota(vertex_.begin(), vertex_.end(), 0);
  } else {
    vertex_ = surface.locality_order();
  }
  place_.resize(count);
  for (int place = 0; place < count; ++place) place_[vertex_[place]] = place;
  vertex_.resize(static_cast<std::size_t>(tiles) * kLanes, vertex_.back());
  if (is_intrinsic) return;
  coordinates_.resize(vertex_.size() * 3);
  for (std::size_t place = 0; place < vertex_.size(); ++place) {
    const Vec3 x = prior.coordinates(vertex_[place]);
    for (int axis = 0; axis < 3; ++axis)
      coordinates_[(place / kLanes * 3 + axis) * kLanes + place % kLanes] = x[axis];
  }
}

}  // namespace palpation
