#include <algorithm>

#include "palpation/exploration/exploration.h"
#include "palpation/geometry/path.h"

namespace palpation {
namespace {

constexpr double kPathStep_m =
    0.001;  // the robot's readings: one per mm (Garg et al. 2016, section VII)

Vec3 direction(const Vec3& from, const Vec3& to) {
  const Vec3 difference = to - from;
  const double length = difference.norm();
  return length > 0.0 ? Vec3(difference / length) : Vec3(Vec3::Zero());
}

}  // namespace

Tour travel(const Surface& surface, std::span<const int> stops,
            const std::optional<SurfacePoint>& from, const Probe& probe, double way_step_m) {
  Tour tour;
  std::optional<SurfacePoint> here = from;
  const auto touch = [&](const SurfacePoint& where, const Vec3& heading, TouchKind kind) {
    std::optional<Palpation> felt = probe(where, heading);
    if (!felt && kind == TouchKind::Stop) tour.palpations.push_back(missed_at(where));
    if (!felt) return;
    felt->kind = kind;
    if (felt->travel.isZero(0.0)) felt->travel = heading;
    tour.palpations.push_back(*felt);
  };
  for (int leg = 0; leg < static_cast<int>(stops.size()); ++leg) {
    const SurfacePoint target = surface.at_vertex(stops[static_cast<std::size_t>(leg)]);
    Vec3 heading = Vec3::Zero();
    if (here) {
      const Vec3 start = surface.position(*here);
      heading = direction(start, surface.position(target));
      Vec3 previous = start;
      for (const SurfacePoint& place : way_between(surface, *here, target, kPathStep_m)) {
        tour.way.push_back(place);
        tour.legs.push_back(leg);
        tour.length_m += (surface.position(place) - previous).norm();
        previous = surface.position(place);
      }
      tour.length_m += (surface.position(target) - previous).norm();
      if (way_step_m > 0.0) {
        Vec3 before = start;
        for (const SurfacePoint& place : way_between(surface, *here, target, way_step_m)) {
          touch(place, direction(before, surface.position(place)), TouchKind::Way);
          before = surface.position(place);
        }
      }
    }
    touch(target, heading, TouchKind::Stop);
    here = target;
  }
  return tour;
}

void run(Exploration& exploration, const Probe& probe,
         const std::function<void(const Tour&)>& after_batch, double way_step_m) {
  std::optional<SurfacePoint> here;
  for (std::vector<int> stops = exploration.next(); !stops.empty(); stops = exploration.next()) {
    Tour tour = travel(exploration.surface(), stops, here, probe, way_step_m);
    for (Palpation& palpation : tour.palpations) palpation.batch = exploration.batch();
    here = exploration.surface().at_vertex(stops.back());
    exploration.record(tour.palpations);
    if (after_batch) after_batch(tour);
  }
}

}  // namespace palpation
