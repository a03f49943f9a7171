#include "scene/next_plan.h"

#include <algorithm>
#include <utility>

#include "palpation/base/error.h"
#include "scene/setup.h"

namespace palpation::tool {
namespace {

/// The poses of the next stops, the probe turned as it is after all stops before.
std::vector<Waypoint> poses_after(const Surface& surface, std::span<const Palpation> before,
                                  std::span<const SurfacePoint> stops, const Robot& robot) {
  std::vector<SurfacePoint> all;
  for (const Palpation& one : before) {
    if (one.kind != TouchKind::Way) all.push_back(one.where);
  }
  const auto made = static_cast<std::ptrdiff_t>(all.size());
  all.insert(all.end(), stops.begin(), stops.end());
  std::vector<Waypoint> poses = waypoints(surface, all, robot);
  poses.erase(poses.begin(), poses.begin() + made);
  return poses;
}

bool is_kept_out(const Scene& scene, const Vec3& place) {
  return std::ranges::any_of(
      scene.points_mm("plan.keep_out_mm"), [&](const std::vector<double>& ball) {
        return (place - Vec3(ball[0], ball[1], ball[2]) / 1000.0).norm() <= ball[3] / 1000.0;
      });
}

/// A person's places in front of what was chosen, each once; none of those to be kept out of.
std::vector<int> with_wishes(const Scene& scene, const Surface& surface,
                             const std::vector<int>& chosen) {
  std::vector<int> stops;
  const auto add = [&](int vertex) {
    if (std::ranges::find(stops, vertex) == stops.end()) stops.push_back(vertex);
  };
  for (const std::vector<double>& place : scene.points_mm("plan.touch_first_mm")) {
    const int vertex = surface.nearest_vertex(Vec3(place[0], place[1], place[2]) / 1000.0);
    if (!is_kept_out(scene, surface.vertex(vertex))) add(vertex);
  }
  std::ranges::for_each(chosen, add);
  return stops;
}

}  // namespace

void check_plans(const Scene& scene) {
  if (is_scan(scene))
    scene.refuse("plan.acquisition",
                 "raster and refinement are whole scans, which palpate simulate and replay run: "
                 "there is no next batch");
}

MeasurementsFile measured_on(const Scene& scene, const Surface& surface, const CsvTable& table) {
  const bool noiseless = field_of(scene).is_noiseless();
  MeasurementsFile measured = measurements_of(
      table, surface,
      {.empty_noise_is_none = noiseless,
       .leave_out_off_tissue = scene.word("surface.off_tissue") == "leave-out",
       .reading_unit = scene.gives("reading_unit") ? scene.word("reading_unit") : ""});
  if (measured.places > kMostPlaces)
    throw IoError(table.name() + ": readings at " + std::to_string(measured.places) +
                  " places; at most " + std::to_string(kMostPlaces) +
                  " can be modelled: leave some out, or set them aside");
  return measured;
}

NextPlan next_plan(const Scene& scene, const Surface& surface,
                   std::span<const Palpation> palpations) {
  const bool asks = scene.word("certainty") != "off";
  NextPlan plan{.episode = episode_from(asks ? scene.with("certainty", "laplace") : scene, surface,
                                        palpations)};
  const Choice choice = next_of(scene, surface, plan.episode);
  plan.episode.coarse_stop_reason = choice.stop_reason;
  plan.stops = with_wishes(scene, surface, choice.stops);
  const std::vector<Palpation> before = plan.episode.exploration.readings();

  std::vector<SurfacePoint> places;
  std::optional<SurfacePoint> here;
  if (!before.empty()) here = before.back().where;
  for (const int stop : plan.stops) places.push_back(surface.at_vertex(stop));
  const Tour tour = travel(
      surface, plan.stops, here,
      [](const SurfacePoint&, const Vec3&) { return std::optional<Palpation>(); }, 0.0);
  const Robot robot = robot_of(scene);
  plan.poses = poses_after(surface, before, places, robot);
  plan.way = waypoints(surface, tour.way, robot);
  plan.legs = tour.legs;
  plan.length_m = tour.length_m;
  return plan;
}

}  // namespace palpation::tool
