#include <memory>

#include "geometry/closest_point.h"
#include "geometry/surface_state.h"
#include "palpation/base/error.h"

namespace palpation {

SurfacePoint Surface::project(const Vec3& position) const {
  if (!position.allFinite()) throw InvalidInput("Surface::project: position must be finite");
  std::call_once(state_->closest_point_once, [this] {
    state_->closest_point = std::make_shared<const ClosestPoint>(
        state_->mesh, state_->connectivity.face_of_vertex, state_->diameter);
    note_computed("search tree");
  });
  return state_->closest_point->to(position);
}

}  // namespace palpation
