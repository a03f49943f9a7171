#include "scene/setup.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "palpation/base/error.h"
#include "palpation/geometry/distance.h"
#include "scene/registration_file.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

Metric metric_named(const std::string& name) {
  if (name == "ambient") return Metric::Ambient;
  return name == "intrinsic" ? Metric::Intrinsic : Metric::Chart;
}

KernelFamily kernel_family(const std::string& name) {
  if (name == "matern-1/2") return KernelFamily::Matern12;
  if (name == "matern-3/2") return KernelFamily::Matern32;
  if (name == "matern-5/2") return KernelFamily::Matern52;
  if (name == "periodic") return KernelFamily::Periodic;
  return KernelFamily::SquaredExponential;
}

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

Learnable learnable(const Scene& scene, const char* key) {
  return scene.word(key) == "learn" ? kLearned : Learnable(scene.number(key));
}

Learnable learnable_metres(const Scene& scene, const char* key) {
  return scene.word(key) == "learn" ? kLearned : Learnable(scene.metres(key));
}

KernelModel kernel_model_of(const Scene& scene, Metric metric) {
  KernelModel kernel{.family = kernel_family(scene.word("field.kernel")),
                     .length_m = learnable_metres(scene, "field.length_mm"),
                     .signal_sd = learnable(scene, "field.signal_sd"),
                     .length_median_m = scene.metres("field.length_prior_mm")};
  if (kernel.family == KernelFamily::Periodic) {
    if (metric != Metric::Chart)
      scene.refuse("field.kernel", "is \"periodic\", which needs field.metric chart");
    kernel.period_m = scene.metres("field.period_mm");
  }
  if (kernel.family == KernelFamily::Matern12 && metric == Metric::Intrinsic)
    scene.refuse("field.kernel",
                 "is \"matern-1/2\", which field.metric intrinsic does not have: take "
                 "squared-exponential, matern-3/2 or matern-5/2");
  return kernel;
}

NoiseModel noise_of(const Scene& scene, const KernelModel& kernel) {
  NoiseModel noise{.sd = learnable(scene, "field.noise"),
                   .heavy_tails = scene.truth("field.heavy_tails")};
  if (!scene.has("field.noise_to_signal")) return noise;
  if (!noise.sd.is_learned())
    scene.refuse("field.noise_to_signal", "stands in place of field.noise: give one of them");
  if (kernel.length_m.is_learned() || kernel.signal_sd.is_learned())
    scene.refuse("field.noise_to_signal", "needs a fixed field.length_mm and field.signal_sd");
  noise.sd = scene.number("field.noise_to_signal");
  noise.is_relative = true;
  return noise;
}

/// Single precision needs noise, and to know how much.
void check_precision(const Scene& scene, const FieldModel& field) {
  if (!field.economy.single_precision || field.learns()) return;
  const bool is_relative = field.noise.is_relative;
  if (field.standardize && !is_relative)
    scene.refuse(
        "field.precision",
        "is single, but how large a fixed field.noise is beside standardized readings shows only "
        "when they are felt: set "
        "field.standardize to false, or give field.noise_to_signal in place of field.noise");
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

/// Values in the reading's unit have no meaning beside logarithms.
ReadingScale scale_of(const Scene& scene) {
  if (scene.word("field.transform") == "none") return ReadingScale::Raw;
  for (const char* key : {"field.signal_sd", "field.noise"}) {
    if (scene.word(key) != "learn")
      scene.refuse(key,
                   "is in the reading's unit, which logarithms (field.transform log) do not "
                   "have: set it to learn");
  }
  if (scene.word("level.estimate") == "known" && scene.number("level.value") <= 0.0)
    scene.refuse_value("level.value", "above 0, where field.transform is log");
  if (scene.has("plan.min_contrast") && scene.number("plan.min_contrast") <= 1.0)
    scene.refuse_value("plan.min_contrast", "above 1: where field.transform is log it is a factor");
  return ReadingScale::Log;
}

LevelRule level_rule_of(const Scene& scene) {
  LevelRule rule;
  rule.fraction = scene.number("level.fraction");
  if (scene.word("level.estimate") == "known") rule.known = scene.number("level.value");
  rule.estimate =
      scene.word("level.estimate") == "range" ? LevelEstimate::Range : LevelEstimate::Edge;
  return rule;
}

}  // namespace

FieldModel field_of(const Scene& scene) {
  FieldModel field{.metric = metric_named(scene.word("field.metric")),
                   .standardize = scene.truth("field.standardize")};
  field.kernel = kernel_model_of(scene, field.metric);
  field.noise = noise_of(scene, field.kernel);
  field.trend.is_linear = scene.word("field.trend") == "linear";
  if (scene.word("field.trend") == "zero")
    field.trend.constant.sd = 0.0;
  else if (scene.has("field.constant_sd"))
    field.trend.constant.sd = scene.number("field.constant_sd");
  field.economy = {.reduced_rank_tolerance = scene.number("field.reduced_rank"),
                   .single_precision = scene.word("field.precision") == "single",
                   .rebuild_gain = scene.number("field.rebuild_gain")};
  check_precision(scene, field);
  field.probe = {.lag_m = learnable_metres(scene, "field.lag_mm"),
                 .indenter_radius_m = scene.metres("field.indenter_radius_mm"),
                 .screening = scene.truth("field.screening")};
  return field;
}

/// Of a standard deviation, where a normal's 95 % lie.
constexpr double kTwoSided95 = 1.959963984540054;

Model model_of(const Scene& scene) {
  return {.field = field_of(scene),
          .level = level_rule_of(scene),
          .band = {.probability = scene.number("band.probability"),
                   .place_sd_m = place_uncertainty_m(scene) / kTwoSided95},
          .contrast = {.scale = scale_of(scene),
                       .least = scene.has("plan.min_contrast")
                                    ? std::optional(scene.number("plan.min_contrast"))
                                    : std::nullopt,
                       .safe_start = scene.truth("plan.safe_start")}};
}

Plan plan_of(const Scene& scene) {
  Plan plan;
  plan.acquisition = acquisition_of(scene);
  const std::string design = scene.word("plan.initial.design");
  plan.initial = {.design = design == "random" ? Design::Random
                            : design == "grid" ? Design::Grid
                                               : Design::LowDiscrepancy,
                  .count = scene.integer("plan.initial.count"),
                  .seed = scene.seed()};
  plan.batch.size = scene.integer("plan.batch");
  if (scene.truth("plan.readings_along_path")) plan.batch.way_reading_m = kWayStep_m;
  plan.batch.least_spacing_m = scene.metres("plan.least_spacing_mm");
  plan.batches = scene.integer("plan.batches");
  plan.stop = {.error_m2 = scene.number("plan.stop.expected_error_mm2") * 1e-6,
               .band_m = scene.metres("plan.stop.band_mm"),
               .least_gain = scene.number("plan.stop.least_gain")};
  plan.aim.edge_share =
      scene.word("plan.acquisition") == "auto" ? scene.number("plan.edge_share") : 0.0;
  if (scene.has("plan.goal.max_undetected_diameter_mm"))
    plan.aim.undetected_diameter_m = scene.metres("plan.goal.max_undetected_diameter_mm");
  plan.aim.probability = scene.number("plan.goal.probability");
  return plan;
}

Robot robot_of(const Scene& scene) {
  Robot robot;
  const std::vector<double> rows = scene.numbers("robot.from_tissue");
  for (int i = 0; i < 16; ++i) robot.from_tissue(i / 4, i % 4) = rows[i];
  if (const auto registration = registration_of(scene))
    robot.from_tissue = registration->from_tissue;
  robot.standoff_m = scene.metres("robot.standoff_mm");
  robot.indent_m = scene.metres("robot.indent_mm");
  robot.spring_n_per_m = scene.number("robot.spring_n_per_m");
  try {
    check(robot);
  } catch (const InvalidInput& error) {
    scene.refuse("robot.from_tissue", without("Robot: from_tissue ", error.what()));
  }
  return robot;
}

Access access_of(const Scene& scene) {
  Access access;
  if (scene.gives("robot.shaft_direction")) {
    const std::vector<double> direction = scene.numbers("robot.shaft_direction");
    const Eigen::Matrix3d to_robot = robot_of(scene).from_tissue.topLeftCorner<3, 3>();
    access.shaft_direction = to_robot.transpose() * Vec3(direction[0], direction[1], direction[2]);
  }
  access.cone_rad = scene.number("robot.cone_deg") * std::numbers::pi / 180.0;
  access.clearance_m = scene.metres("robot.clearance_mm");
  access.probe_radius_m = scene.metres("robot.probe_radius_mm");
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
