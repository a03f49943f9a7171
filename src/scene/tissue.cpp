#include "scene/tissue.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <utility>

#include "palpation/base/contract.h"
#include "palpation/geometry/clearance.h"
#include "palpation/geometry/patch.h"
#include "scene/mesh_words.h"
#include "scene/registration_file.h"
#include "scene/scale_remarks.h"
#include "scene/setup.h"
#include "scene/surface_remarks.h"
#include "scene/tissue_mesh.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

constexpr double kFarthestRobot_m = 10.0;
constexpr double kTold_m = 0.0005;  // an uncertainty that is worth a sentence

constexpr double kMostTriangles = 8e6;
constexpr double kMostLengthRatio = 1e6;

/// A mesh that is no surface is the fault of its file.
Surface surface_of(const Scene& scene, TriangleMesh mesh) {
  try {
    return Surface(std::move(mesh));
  } catch (const InvalidMesh& error) {
    const std::string file = scene.gives("surface.mesh") ? mesh_path(scene).string() : scene.name();
    throw InvalidMesh(file + ": " + without("Surface: ", error.what()) +
                      " (positions in metres; palpate info tells more)");
  }
}

TriangleMesh patch_around_centre(const Scene& scene, const Surface& whole, double margin_m = 0.0) {
  const Vec3 centre = scene.point_m("surface.patch.centre_mm");
  const double away_m = (whole.position(whole.project(centre)) - centre).norm();
  if (away_m > scene.metres("surface.patch.radius_mm"))
    scene.refuse_value("surface.patch.centre_mm",
                       "no farther from the tissue than surface.patch.radius_mm, but it is " +
                           fixed(away_m * 1e3, 1) + " mm away from tissue that is " +
                           fixed(whole.diameter() * 1e3, 1) + " mm across: is surface.unit right?");
  try {
    return patch_around(whole, centre, scene.metres("surface.patch.radius_mm") + margin_m);
  } catch (const InvalidInput&) {
    scene.refuse_value(
        "surface.patch.radius_mm",
        "large enough for a triangle of the mesh around the centre: take a larger one");
  }
}

bool gives_tests(const Scene& scene) {
  return scene.gives("surface.patch.box_mm") || scene.gives("surface.patch.facing");
}

TriangleMesh patch_by_tests(const Scene& scene, TriangleMesh mesh) {
  PatchTests tests;
  if (scene.gives("surface.patch.box_mm")) {
    const std::vector<double> box = scene.numbers("surface.patch.box_mm");
    tests.box = {Vec3(box[0], box[1], box[2]) / 1000.0, Vec3(box[3], box[4], box[5]) / 1000.0};
  }
  if (scene.gives("surface.patch.facing")) {
    const std::vector<double> direction = scene.numbers("surface.patch.facing");
    tests.facing = {Vec3(direction[0], direction[1], direction[2]),
                    scene.number("surface.patch.within_deg") * std::numbers::pi / 180.0};
  }
  std::optional<Vec3> centre;
  if (scene.gives("surface.patch.centre_mm")) centre = scene.point_m("surface.patch.centre_mm");
  const Surface whole = surface_of(scene, std::move(mesh));
  try {
    return patch_passing(whole, tests, centre);
  } catch (const InvalidInput&) {
    scene.refuse("surface.patch",
                 "leaves no triangle of the mesh: take a larger box or angle (palpate info tells "
                 "where the mesh is)");
  }
}

double longest_edge_m(const TriangleMesh& mesh) {
  double longest = 0.0;
  for (Eigen::Index face = 0; face < mesh.triangles.rows(); ++face) {
    for (int i = 0; i < 3; ++i)
      longest = std::max(longest, (mesh.vertices.row(mesh.triangles(face, i)) -
                                   mesh.vertices.row(mesh.triangles(face, (i + 1) % 3)))
                                      .norm());
  }
  return longest;
}

/// Every pass halves the edges and makes four triangles of one.
TriangleMesh refined(const Scene& scene, TriangleMesh mesh) {
  const double target_m = scene.metres("surface.refine_mm");
  const double longest_m = longest_edge_m(mesh);
  double triangles = static_cast<double>(mesh.triangles.rows());
  for (double edge_m = longest_m; edge_m > target_m && triangles <= kMostTriangles; edge_m /= 2.0)
    triangles *= 4.0;
  if (triangles > kMostTriangles)
    scene.refuse_value("surface.refine_mm",
                       "coarser: from " + std::to_string(mesh.triangles.rows()) +
                           " triangles with edges up to " + text_of(longest_m * 1000.0) +
                           " mm it would take more than 8 million");
  return refine(std::move(mesh), target_m);
}

/// What a scene asks of its tissue that it cannot give.
void check_size(const Scene& scene, const Surface& surface) {
  const std::string vertices =
      std::to_string(surface.vertex_count()) + ", the vertices of the tissue";
  for (const char* count : {"plan.batch", "plan.initial.count"}) {
    if (scene.gives(count) && scene.integer(count) > surface.vertex_count())
      scene.refuse_value(count, "at most " + vertices);
  }
  for (const char* length : {"field.length_mm", "field.length_prior_mm", "field.period_mm"}) {
    if (!scene.gives(length) || scene.word(length) == "learn") continue;
    const double ratio = scene.metres(length) / surface.diameter();
    if (ratio < 1.0 / kMostLengthRatio || ratio > kMostLengthRatio)
      scene.refuse_value(length, "a millionth to a million times the tissue's size, which is " +
                                     text_of(surface.diameter() * 1000.0) + " mm");
  }
}

bool gives_patch(const Scene& scene) {
  return scene.gives("surface.patch.radius_mm") || gives_tests(scene);
}

/// Of triangles that have a corner as near to the patch's centre, in a straight line, as the patch
/// is to reach along the surface, or that hold the place nearest to it.
double longest_edge_near_patch_m(const Scene& scene, const Surface& whole) {
  const SurfacePoint middle = whole.project(scene.point_m("surface.patch.centre_mm"));
  const Vec3 centre = whole.position(middle);
  const double radius_m = scene.metres("surface.patch.radius_mm");
  double longest = 0.0;
  for (int face = 0; face < whole.face_count(); ++face) {
    const Eigen::Vector3i corners = whole.triangle(face);
    const bool is_near = face == middle.face || std::ranges::any_of(corners, [&](int corner) {
                           return (whole.vertex(corner) - centre).norm() <= radius_m;
                         });
    for (int i = 0; is_near && i < 3; ++i)
      longest =
          std::max(longest, (whole.vertex(corners[i]) - whole.vertex(corners[(i + 1) % 3])).norm());
  }
  return longest;
}

/// What the scene's patch keeps of the mesh, refined. Coarse triangles would leave it a border of
/// teeth: around a centre it is cut with room for one of them, refined, and cut again.
TriangleMesh patched_and_refined(const Scene& scene, TriangleMesh mesh) {
  const bool is_around_centre = scene.gives("surface.patch.radius_mm"),
             refines = scene.gives("surface.refine_mm");
  if (is_around_centre) {
    const Surface whole = surface_of(scene, std::move(mesh));
    mesh =
        patch_around_centre(scene, whole, refines ? longest_edge_near_patch_m(scene, whole) : 0.0);
  }
  if (gives_tests(scene)) mesh = patch_by_tests(scene, std::move(mesh));
  if (refines && !gives_patch(scene))
    surface_of(scene, mesh);  // its faults are named by the numbers of the file
  if (refines) mesh = refined(scene, std::move(mesh));
  return is_around_centre && refines
             ? patch_around_centre(scene, surface_of(scene, std::move(mesh)))
             : mesh;
}

/// A scene is sound as a whole before anything is read for it.
void check_all(const Scene& scene) {
  const std::string strategy = scene.word("plan.acquisition");
  if (limits_reach(scene) && (strategy == "raster" || strategy == "refinement"))
    scene.refuse("plan.acquisition",
                 "is " + strategy +
                     ", a scan that takes no account of robot.shaft_direction, "
                     "robot.clearance_mm, robot.margin_mm and plan.keep_out_mm: "
                     "leave them out");
  model_of(scene);
  plan_of(scene);
  robot_of(scene);
  if (scene.gives("surface.patch.radius_mm") && !scene.gives("surface.patch.centre_mm"))
    scene.refuse("surface.patch", "has a radius but no centre_mm");
  if (scene.gives("surface.patch.centre_mm") && !scene.gives("surface.patch.radius_mm") &&
      !gives_tests(scene))
    scene.refuse(
        "surface.patch.radius_mm",
        "is needed here: how far the patch goes from its centre_mm (or give box_mm, or facing)");
}

/// Nobody asked, but an approach must not lead through the tissue.
void warn_of_hidden_tissue(const Scene& scene, Tissue& tissue) {
  const double standoff_m = scene.metres("robot.standoff_mm");
  if (tissue.surface.is_planar() || standoff_m == 0.0) return;
  const std::vector<bool> clear = clear_vertices(tissue.surface, standoff_m);
  double hidden_m2 = 0.0;
  for (int vertex = 0; vertex < tissue.surface.vertex_count(); ++vertex)
    hidden_m2 += clear[vertex] ? 0.0 : tissue.surface.vertex_areas()[vertex];
  const double percent = 100.0 * hidden_m2 / tissue.surface.area();
  if (percent > 0.05)
    tissue.warnings.push_back(
        scene.name() + ": over " + fixed(percent, 1) +
        " % of the tissue the approach from robot.standoff_mm passes through another part of it. "
        "Set robot.clearance_mm to keep the probe away from there.");
}

void warn_of_reach(const Scene& scene, Tissue& tissue) {
  const std::optional<std::vector<int>> reached = reachable_of(scene, tissue.surface);
  if (scene.metres("robot.clearance_mm") == 0.0 && !scene.gives("robot.shaft_direction"))
    warn_of_hidden_tissue(scene, tissue);
  if (!reached) return;
  double reached_m2 = 0.0;
  for (const int vertex : *reached) reached_m2 += tissue.surface.vertex_areas()[vertex];
  const double percent = 100.0 * (1.0 - reached_m2 / tissue.surface.area());
  if (percent > 0.05)
    tissue.warnings.push_back(
        scene.name() + ": " + fixed(percent, 1) +
        " % of the tissue cannot be reached or is kept out: it will not be touched, and the "
        "boundary there is a guess.");
}

/// The chart is what the boundary is drawn in; without one, say what is in the way and what to do.
void check_chart(const Scene& scene, const Surface& surface) {
  if (gives_patch(scene) && surface.topology().is_closed())
    scene.refuse(
        "surface.patch",
        "takes all of a closed surface, " + fixed(surface.diameter() * 1e3, 1) +
            " mm across, which cannot be flattened: take a smaller part, and check surface.unit");
  const std::string next = gives_patch(scene) ? ": take a smaller or another part by surface.patch"
                                              : ": choose a part to work on by surface.patch "
                                                "(centre_mm and radius_mm, or box_mm, or facing)";
  if (surface.topology().is_closed())
    scene.refuse("surface",
                 "the mesh is a closed surface, which cannot be flattened as a whole" + next);
  try {
    surface.chart();
  } catch (const InvalidInput& error) {
    scene.refuse("surface", rule_words(error) + next);
  }
}

/// A translation in millimetres plans a thousand times too far away.
std::string translation_warning(const Scene& scene) {
  const Vec3 translation = robot_of(scene).from_tissue.topRightCorner<3, 1>();
  const double length_m = translation.cwiseAbs().maxCoeff();
  if (length_m <= kFarthestRobot_m) return "";
  return scene.name() + ": robot.from_tissue: its translation of " + text_of(length_m) +
         " m is farther than robots of this kind reach. It is in metres: was it meant in "
         "millimetres?";
}

/// What a registration leaves open is of everything that is found.
std::string placement_warning(const Scene& scene) {
  const double off_m = place_uncertainty_m(scene);
  if (off_m < kTold_m) return "";
  return "All that is felt may lie " + fixed(off_m * 1e3, 1) +
         " mm off along the tissue, the same way, with 95 %: so well the robot is registered. The "
         "band is wider by it.";
}

/// Where lengths in the chart are not those on the tissue, a metric that takes them for it
/// misleads.
std::string stretch_warning(const Scene& scene, const Surface& surface) {
  const Distortion& distortion = surface.chart().distortion;
  if (scene.word("field.metric") != "chart" || !misleads(distortion)) return "";
  return "Flattened, the tissue is " + stretch_words(distortion) +
         ": with field.metric chart, the field's length is off by as much there. Take field.metric "
         "intrinsic or a smaller patch; areas and errors are "
         "measured on the tissue all the same.";
}

}  // namespace

Tissue tissue_of(const Scene& scene) {
  check_all(scene);
  std::vector<std::string> warnings = scene.warnings();
  MeshOfScene whole = mesh_of(scene, warnings);
  TriangleMesh mesh = patched_and_refined(scene, std::move(whole.mesh));
  Tissue tissue{surface_of(scene, std::move(mesh)), std::move(warnings), whole.frame};
  check_chart(scene, tissue.surface);
  check_size(scene, tissue.surface);
  warn_of_reach(scene, tissue);
  for (const std::string& warning : {translation_warning(scene), placement_warning(scene),
                                     stretch_warning(scene, tissue.surface)}) {
    if (!warning.empty()) tissue.warnings.push_back(warning);
  }
  for (std::string& warning : scale_remarks(scene, tissue.surface))
    tissue.warnings.push_back(std::move(warning));
  return tissue;
}

std::vector<std::string> start_remarks(const Tissue& tissue) {
  std::vector<std::string> remarks = tissue.warnings;
  for (std::string& remark : surface_remarks(tissue.surface)) remarks.push_back(std::move(remark));
  return remarks;
}

}  // namespace palpation::tool
