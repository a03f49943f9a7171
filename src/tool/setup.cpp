#include "tool/setup.h"

#include <cmath>
#include <numbers>

#include "palpation/base/error.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/geometry/patch.h"
#include "palpation/io/read_mesh.h"

namespace palpation::tool {
namespace {

TriangleMesh mesh_of(const Scene& scene, std::vector<std::string>& warnings) {
  if (scene.has("surface.plane.size_mm") && !scene.has("surface.mesh")) {
    const std::vector<double> size_mm = scene.numbers("surface.plane.size_mm");
    const std::vector<double> vertices = scene.numbers("surface.plane.vertices");
    if (vertices[0] != std::floor(vertices[0]) || vertices[1] != std::floor(vertices[1]))
      scene.refuse("surface.plane.vertices", "must be whole numbers");
    Random unused(0);
    return make_plane(
        {.size_m = Vec2(size_mm[0], size_mm[1]) / 1000.0, .columns = static_cast<int>(vertices[0]), .rows = static_cast<int>(vertices[1])},
        unused);
  }
  MeshFile file = read_mesh(scene.folder() / scene.word("surface.mesh"), length_unit(scene.word("surface.unit")));
  for (const MeshWarning& warning : file.warnings) warnings.push_back(warning.text);
  return file.mesh;
}

KernelFamily kernel_family(const std::string& name) {
  if (name == "matern-1/2") return KernelFamily::Matern12;
  if (name == "matern-3/2") return KernelFamily::Matern32;
  if (name == "matern-5/2") return KernelFamily::Matern52;
  if (name == "periodic") return KernelFamily::Periodic;
  return KernelFamily::SquaredExponential;
}

/// The chart is what the boundary is drawn in; without one, say what to do.
void check_chart(const Scene& scene, const Surface& surface) {
  if (surface.has_chart()) return;
  if (surface.topology().is_closed()) {
    scene.refuse("surface",
                 "the mesh is a closed surface, which cannot be laid flat as a whole: choose a flat part to work on by surface.patch "
                 "(centre_mm and radius_mm)");
  }
  scene.refuse("surface",
               "the tissue is curved, and boundaries are drawn on flat tissue only so far: choose a flat part by surface.patch (palpate "
               "info tells what the mesh is)");
}

Acquisition acquisition_of(const Scene& scene) {
  const std::string name = scene.word("plan.acquisition");
  const double gamma = scene.number("plan.gamma");
  const Scaling scaling = scene.word("plan.scaling") == "max" ? Scaling::MaxScaled : Scaling::Raw;
  if (name == "ucb") return ucb(gamma, scaling);
  if (name == "evr") return evr();
  if (name == "straddle") return straddle();
  if (name == "lse") return lse_ambiguity();
  if (name == "random") return random_scores(scene.seed());
  return ils_ucb(gamma, scaling);
}

}  // namespace

Tissue tissue_of(const Scene& scene) {
  if (scene.has("surface.mesh") && scene.has("surface.plane.size_mm"))
    scene.refuse("surface", "has both a mesh and a plane: give one of them");
  if (!scene.has("surface.mesh") && !scene.has("surface.plane.size_mm"))
    scene.refuse("surface.mesh", "is needed: the file of the tissue's mesh");
  if (scene.has("surface.patch.radius_mm") && !scene.has("surface.patch.centre_mm"))
    scene.refuse("surface.patch", "has a radius but no centre_mm");
  std::vector<std::string> warnings;
  TriangleMesh mesh = mesh_of(scene, warnings);
  if (scene.has("surface.patch.centre_mm"))
    mesh = patch_around(Surface(std::move(mesh)), scene.point_m("surface.patch.centre_mm"), scene.metres("surface.patch.radius_mm"));
  if (scene.has("surface.refine_mm")) mesh = refine(std::move(mesh), scene.metres("surface.refine_mm"));
  Tissue tissue{Surface(std::move(mesh)), std::move(warnings)};
  check_chart(scene, tissue.surface);
  return tissue;
}

FieldModel field_of(const Scene& scene) {
  FieldModel field;
  field.metric = scene.word("field.metric") == "ambient" ? Metric::Ambient : Metric::Chart;
  field.kernel.family = kernel_family(scene.word("field.kernel"));
  if (field.kernel.family == KernelFamily::Periodic) field.kernel.period_m = scene.metres("field.period_mm");
  field.learn_length = scene.word("field.length_mm") == "learn";
  if (!field.learn_length) field.kernel.length_m = scene.metres("field.length_mm");
  field.learn_signal = scene.word("field.signal_sd") == "learn";
  if (!field.learn_signal) field.kernel.signal_sd = scene.number("field.signal_sd");
  field.learn_noise = scene.word("field.noise") == "learn" && !scene.has("field.noise_to_signal");
  if (scene.has("field.noise_to_signal")) {
    if (scene.word("field.noise") != "learn") scene.refuse("field.noise_to_signal", "stands in place of field.noise: give one of them");
    if (field.learn_length || field.learn_signal)
      scene.refuse("field.noise_to_signal", "needs a fixed field.length_mm and field.signal_sd");
    field.belief.noise_sd = scene.number("field.noise_to_signal");
    field.belief.noise_is_relative = true;
  } else if (!field.learn_noise) {
    field.belief.noise_sd = scene.number("field.noise");
  }
  field.length_median_m = scene.metres("field.length_prior_mm");
  if (scene.word("field.trend") == "zero")
    field.constant.sd = 0.0;
  else if (scene.has("field.constant_sd"))
    field.constant.sd = scene.number("field.constant_sd");
  field.belief.standardize = scene.truth("field.standardize");
  return field;
}

LevelRule level_rule_of(const Scene& scene) {
  LevelRule rule;
  rule.fraction = scene.number("level.fraction");
  if (scene.word("level.estimate") == "known") rule.known = scene.number("level.value");
  return rule;
}

Plan plan_of(const Scene& scene) {
  Plan plan;
  plan.acquisition = acquisition_of(scene);
  const std::string design = scene.word("plan.initial.design");
  plan.initial = design == "random" ? Design::Random : design == "grid" ? Design::Grid : Design::LowDiscrepancy;
  plan.initial_count = scene.integer("plan.initial.count");
  plan.batch.size = scene.integer("plan.batch");
  plan.batch.least_spacing_m = scene.metres("plan.least_spacing_mm");
  plan.batches = scene.integer("plan.batches");
  plan.stop_error_m2 = scene.number("plan.stop.expected_error_mm2") * 1e-6;
  plan.safe_start = scene.truth("plan.safe_start");
  return plan;
}

Robot robot_of(const Scene& scene) {
  Robot robot;
  const std::vector<double> rows = scene.numbers("robot.from_tissue");
  for (int i = 0; i < 16; ++i) robot.from_tissue(i / 4, i % 4) = rows[i];
  robot.standoff_m = scene.metres("robot.standoff_mm");
  robot.indent_m = scene.metres("robot.indent_mm");
  try {
    check(robot);
  } catch (const InvalidInput& error) {
    scene.refuse("robot", error.what());
  }
  return robot;
}

Phantom phantom_of(const Scene& scene, const Surface& surface) {
  StiffnessModel model;
  model.low = scene.number("probe.low");
  model.high = scene.number("probe.high");
  model.slope_per_m = scene.number("probe.slope_per_m");
  model.noise = scene.number("probe.noise");
  model.bias = scene.number("probe.bias");
  model.fraction = scene.number("level.fraction");
  if (scene.has("probe.bias_axis")) {
    const std::vector<double> axis = scene.numbers("probe.bias_axis");
    model.bias_axis = Vec3(axis[0], axis[1], axis[2]);
  }
  const auto point = [](const nlohmann::json& mm) {
    return Vec3(Vec3(mm[0].get<double>(), mm[1].get<double>(), mm[2].get<double>()) / 1000.0);
  };
  std::vector<Tumour> tumours;
  for (const nlohmann::json& shape : scene.tumours()) {
    if (shape["shape"] == "disk") {
      tumours.emplace_back(Disk{point(shape["centre_mm"]), shape["radius_mm"].get<double>() / 1000.0});
    } else if (shape["shape"] == "horseshoe") {
      Horseshoe horseshoe{point(shape["centre_mm"]), shape["arc_radius_mm"].get<double>() / 1000.0,
                          shape["half_width_mm"].get<double>() / 1000.0};
      horseshoe.arc_rad = shape.value("arc_deg", 180.0) * std::numbers::pi / 180.0;
      if (shape.contains("facing")) horseshoe.facing = 1000.0 * point(shape["facing"]);
      tumours.emplace_back(horseshoe);
    } else {
      Outline outline;
      for (const nlohmann::json& corner : shape["points_mm"]) outline.points_m.push_back(point(corner));
      tumours.emplace_back(outline);
    }
  }
  try {
    return Phantom(surface, std::move(tumours), model);
  } catch (const InvalidInput& error) {
    scene.refuse("probe", error.what());
  }
}

}  // namespace palpation::tool
