#include "scene/scene_session.h"

#include <array>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <utility>

#include "palpation/base/error.h"
#include "scene/digest.h"
#include "scene/next_plan.h"
#include "scene/registration_file.h"
#include "scene/result_tables.h"
#include "scene/scene_schema.h"
#include "scene/setup.h"
#include "scene/tissue_mesh.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

constexpr double kMm = 1e3;  // in a metre

json in_mm(const Vec3& point) { return {point.x() * kMm, point.y() * kMm, point.z() * kMm}; }

/// "2026-11-23T08:00:00.123Z".
std::string now_utc() {
  std::timespec now{};
  std::timespec_get(&now, TIME_UTC);
  std::tm parts{};
  ::gmtime_r(&now.tv_sec, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &parts);
  std::array<char, 8> milliseconds{};
  std::snprintf(milliseconds.data(), milliseconds.size(), ".%03dZ",
                static_cast<int>(now.tv_nsec / 1'000'000));
  return std::string(text.data()) + milliseconds.data();
}

SessionPlan plan_of_question(const Scene& scene, const Surface& surface,
                             const SessionQuestion& question) {
  const Scene asked = scene_asked(scene, question);
  const CsvTable table = parse_csv(question.measurements_csv, "the session's readings");
  const MeasurementsFile measured = measured_on(asked, surface, table);
  const NextPlan next = next_plan(asked, surface, measured.palpations);
  SessionPlan plan{.waypoints_csv = waypoint_csv(next.poses),
                   .path_csv = waypoint_csv(next.way, &next.legs)};
  for (const int stop : next.stops) plan.stops.push_back(surface.vertex(stop));
  if (plan.stops.empty()) plan.stop_reason = next.episode.stop_reason();
  return plan;
}

/// What is in force, and how well the robot is registered, which a file may say, too.
std::string identity_of(const Scene& scene) {
  json all = options_in_force(scene);
  all["robot"]["place_uncertainty_mm"] = place_uncertainty_m(scene) * kMm;
  return all.dump(-1, ' ', true, json::error_handler_t::replace);
}

}  // namespace

SessionSetup session_setup(const Scene& scene, const Surface& surface, bool anyway) {
  check_plans(scene);
  if (!scene.points_mm("plan.touch_first_mm").empty())
    scene.refuse("plan.touch_first_mm",
                 "would come first in every plan of a session: leave it out, and tell the session "
                 "by palpate session SCENE.json DIR touch");
  return {.surface = surface,
          .planner =
              [scene, surface](const SessionQuestion& question) {
                return plan_of_question(scene, surface, question);
              },
          .identity = {identity_of(scene), digest(surface.mesh()),
                       PALPATION_VERSION " " + program_digest()},
          .clock = now_utc,
          .anyway = anyway};
}

Scene scene_asked(const Scene& scene, const SessionQuestion& question) {
  Scene asked = scene;
  if (!question.touch_first.empty()) {
    json places = json::array();
    for (const Vec3& place : question.touch_first) places.push_back(in_mm(place));
    asked = asked.with("plan.touch_first_mm", places);
  }
  if (!question.keep_out.empty()) {
    json balls = scene.complete().at(pointer_to("plan.keep_out_mm"));
    for (const KeepOut& ball : question.keep_out) {
      balls.push_back(in_mm(ball.centre));
      balls.back().push_back(ball.radius_m * kMm);
    }
    asked = asked.with("plan.keep_out_mm", balls);
  }
  return asked;
}

std::string scene_document(const Scene& scene) {
  json given = scene.given();
  if (scene.gives("surface.mesh"))
    given["surface"]["mesh"] = std::filesystem::weakly_canonical(mesh_path(scene)).string();
  if (scene.gives("robot.registration"))
    given["robot"]["registration"] =
        std::filesystem::weakly_canonical(registration_path(scene)).string();
  return given.dump(2, ' ', true, json::error_handler_t::replace) + "\n";
}

}  // namespace palpation::tool
