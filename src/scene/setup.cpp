#include "scene/setup.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "palpation/base/contract.h"
#include "palpation/geometry/distance.h"
#include "scene/bound_keys.h"
#include "scene/gate_setup.h"
#include "scene/registration_file.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

Acquisition acquisition_of(const Scene& scene) {
  const std::string name = scene.word("plan.acquisition");
  const double gamma = scene.number("plan.gamma");
  const Scaling scaling = scene.word("plan.scaling") == "max" ? Scaling::MaxScaled : Scaling::Raw;
  if (name == "ucb") return ucb(gamma, scaling);
  if (name == "evr") return evr();
  if (name == "straddle" || name == "auto") return straddle();
  if (name == "randomized-straddle") return randomized_straddle(scene.seed());
  if (name == "expected-error") return expected_symmetric_difference();
  if (name == "lse") return lse_ambiguity();
  if (name == "random") return random_scores(scene.seed());
  return ils_ucb(gamma, scaling);
}

void check_kernel(const Scene& scene, FieldModel& field) {
  if (field.kernel.family != KernelFamily::Periodic) {
    field.kernel.period_m = 0.0;
  } else {
    if (field.metric != Metric::Chart)
      scene.refuse("field.kernel", "is \"periodic\", which needs field.metric chart");
    scene.value("field.period_mm");
  }
  if (field.kernel.family == KernelFamily::Matern12 && field.metric == Metric::Intrinsic)
    scene.refuse("field.kernel",
                 "is \"matern-1/2\", which field.metric intrinsic does not have: take "
                 "squared-exponential, matern-3/2 or matern-5/2");
}

void take_noise_to_signal(const Scene& scene, const KernelModel& kernel, NoiseModel& noise) {
  if (!scene.has("field.noise_to_signal")) return;
  if (!noise.sd.is_learned())
    scene.refuse("field.noise_to_signal", "stands in place of field.noise: give one of them");
  if (kernel.length_m.is_learned() || kernel.signal_sd.is_learned())
    scene.refuse("field.noise_to_signal", "needs a fixed field.length_mm and field.signal_sd");
  noise.sd = scene.number("field.noise_to_signal");
  noise.is_relative = true;
}

/// Single precision needs noise, and to know how much.
void check_precision(const Scene& scene, const FieldModel& field) {
  if (!field.economy.single_precision || field.learns()) return;
  const bool is_relative = field.noise.is_relative;
  if (field.standardize && !is_relative)
    scene.refuse("field.precision",
                 "is single, but how large a fixed field.noise is beside standardized readings "
                 "shows only when they are felt: set field.standardize to false, or give "
                 "field.noise_to_signal in place of field.noise");
  const double signal_sd = is_relative ? 1.0 : *field.kernel.signal_sd.given();
  if (*field.noise.sd.given() < std::sqrt(kLeastNoiseForSingle) * signal_sd)
    scene.refuse("field.precision",
                 "is single, which needs noise of 3.2 % of the signal at least: take double");
}

/// The tissue's border: its vertices, and the middles of its edges.
std::vector<SurfacePoint> border_of(const Surface& surface) {
  std::vector<SurfacePoint> places;
  for (int face = 0; face < surface.face_count(); ++face) {
    for (int corner = 0; corner < 3; ++corner) {
      if (surface.neighbour(face, corner) >= 0) continue;
      SurfacePoint middle{face, Vec3::Zero()};
      middle.barycentric[corner] = middle.barycentric[(corner + 1) % 3] = 0.5;
      places.push_back(middle);
      places.push_back(surface.at_vertex(surface.triangle(face)[corner]));
    }
  }
  return places;
}

/// A probe may slip off at the tissue's border.
void leave_out_margin(const Scene& scene, const Surface& surface, std::vector<int>& vertices) {
  const double margin_m = scene.metres("robot.margin_mm");
  const std::vector<SurfacePoint> border = border_of(surface);
  if (margin_m == 0.0 || border.empty()) return;
  const Field distance = distance_from(surface, border, margin_m);
  std::erase_if(vertices, [&](int vertex) { return distance[vertex] < margin_m; });
  if (vertices.empty())
    scene.refuse_value("robot.margin_mm", "less: no tissue is left that far from its border");
}

/// What is stopped by, or told, has to be known.
void check_certainty(const Scene& scene, const Plan& plan) {
  if (scene.word("certainty") != "off") return;
  const StopRule& stop = plan.stop;
  for (const auto& [key, limit] : {std::pair{"plan.stop.expected_error_mm2", stop.error_m2},
                                   {"plan.stop.band_mm", stop.band_m},
                                   {"plan.stop.least_gain", stop.least_gain}}) {
    if (limit > 0.0)
      scene.refuse_value(key, "0, where certainty is off: nothing is known then to stop by");
  }
}

/// Values in the reading's unit have no meaning beside logarithms.
void check_logarithms(const Scene& scene, const Model& model) {
  if (model.contrast.scale != ReadingScale::Log) return;
  for (const char* key : {"field.signal_sd", "field.noise"}) {
    if (scene.word(key) != "learn")
      scene.refuse(
          key,
          "is in the reading's unit, which logarithms (field.transform log) do not have: set it to "
          "learn");
  }
  if (model.level.known && *model.level.known <= 0.0)
    scene.refuse_value("level.value", "above 0, where field.transform is log");
  if (model.contrast.least && *model.contrast.least <= 1.0)
    scene.refuse_value("plan.min_contrast", "above 1: where field.transform is log it is a factor");
}

}  // namespace

FieldModel field_of(const Scene& scene) {
  FieldModel field = bound(scene, field_keys());
  check_kernel(scene, field);
  take_noise_to_signal(scene, field.kernel, field.noise);
  check_precision(scene, field);
  return field;
}

/// Of a standard deviation, where a normal's 95 % lie.
constexpr double kTwoSided95 = 1.959963984540054;

Model model_of(const Scene& scene) {
  Model model = bound(scene, model_keys());
  model.field = field_of(scene);
  if (scene.word("level.estimate") == "known") scene.value("level.value");
  if (scene.word("certainty") != "off")
    model.band = Band{scene.number("band.probability"), place_uncertainty_m(scene) / kTwoSided95};
  else
    model.band.reset();
  check_logarithms(scene, model);
  return model;
}

Plan plan_of(const Scene& scene) {
  Plan plan = bound(scene, plan_keys());
  plan.acquisition = acquisition_of(scene);
  if (scene.word("plan.acquisition") != "auto") plan.aim.edge_share = 0.0;
  check_certainty(scene, plan);
  return plan;
}

std::optional<std::uint64_t> outlines_seed_of(const Scene& scene) {
  if (scene.word("certainty") != "sampled") return std::nullopt;
  return scene.seed();
}

Robot robot_of(const Scene& scene) {
  Robot robot = bound(scene, robot_keys());
  if (const auto registration = registration_of(scene))
    robot.from_tissue = registration->from_tissue;
  try {
    check(robot);
  } catch (const BrokenContract& error) {
    scene.refuse("robot.from_tissue", error.rule());
  }
  check_limits(scene);
  return robot;
}

nlohmann::json options_in_force(const Scene& scene) {
  nlohmann::json all = scene.complete();
  const Robot robot = robot_of(scene);
  for (int i = 0; i < 16; ++i) all["robot"]["from_tissue"][i] = robot.from_tissue(i / 4, i % 4);
  return all;
}

Access access_of(const Scene& scene) {
  Access access = bound(scene, access_keys());
  if (scene.gives("robot.shaft_direction")) {
    const std::vector<double> direction = scene.numbers("robot.shaft_direction");
    const Eigen::Matrix3d to_robot = robot_of(scene).from_tissue.topLeftCorner<3, 3>();
    access.shaft_direction = to_robot.transpose() * Vec3(direction[0], direction[1], direction[2]);
  }
  return access;
}

bool limits_reach(const Scene& scene) {
  return scene.gives("robot.shaft_direction") || scene.metres("robot.clearance_mm") > 0.0 ||
         !scene.points_mm("plan.keep_out_mm").empty() || scene.metres("robot.margin_mm") > 0.0;
}

std::optional<std::vector<int>> reachable_of(const Scene& scene, const Surface& surface) {
  if (!limits_reach(scene)) return std::nullopt;
  std::vector<int> vertices = reachable_vertices(surface, access_of(scene));
  if (vertices.empty())
    scene.refuse("robot",
                 "reaches no tissue: with this shaft_direction, cone_deg and clearance_mm nothing "
                 "can be touched");
  for (const std::vector<double>& ball : scene.points_mm("plan.keep_out_mm")) {
    const Vec3 centre = Vec3(ball[0], ball[1], ball[2]) / 1000.0;
    std::erase_if(vertices, [&](int vertex) {
      return (surface.vertex(vertex) - centre).norm() <= ball[3] / 1000.0;
    });
  }
  if (vertices.empty()) scene.refuse("plan.keep_out_mm", "leaves no tissue that can be touched");
  leave_out_margin(scene, surface, vertices);
  return vertices;
}

}  // namespace palpation::tool
