// experiment coverage: whether the band holds the outline as often as it says, over tumours of any
// shape that the method knows nothing of.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "experiments/experiment.h"
#include "palpation/base/error.h"
#include "palpation/certainty/certainty.h"
#include "palpation/certainty/reference_bound.h"
#include "palpation/world/random_shape.h"
#include "scene/remarks.h"
#include "scene/tissue.h"
#include "scene/words.h"
#include "scene/worlds.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

constexpr std::uint64_t kShapeStream = 0x7368617065u;
constexpr double kLeastSlope_per_m = 500.0, kMostSlope_per_m = 2000.0;
constexpr std::array kNoises = {0.01, 0.05, 0.10, 0.25};

/// What one run is held against.
struct Run {
  std::uint64_t seed = 0;
  double noise = 0.0;
  std::string family{};
  double area_m2 = 0.0, slope_per_m = 0.0;
  double error_m2 = 0.0, bound_m2 = 0.0;
  bool found = false;
  bool lost = false;  ///< more than half of the tumour's area is wrong
  bool covered = false;
  double needed_width = 0.0;  // of the band's own
  double half_width_m = 0.0, bound_half_width_m = 0.0;
  double expected_m2 = 0.0;
  std::size_t warnings = 0;
};

json points_mm(const Outline& outline, const Vec3& origin_m) {
  json points = json::array();
  for (const Vec3& point : outline.points_m) {
    const Vec3 place = (point + origin_m) * 1000.0;
    points.push_back({place.x(), place.y(), place.z()});
  }
  return points;
}

/// The part of the tissue's bounding box that shapes are drawn in. Shapes lie in a plane of
/// constant z.
RandomShapeOptions shape_options(const Scene& scene, const Surface& surface) {
  const Vec3 extent =
      (surface.mesh().vertices.colwise().maxCoeff() - surface.mesh().vertices.colwise().minCoeff())
          .transpose();
  if (extent.z() > 1e-9)
    scene.refuse("surface", "must be flat and along x and y, since random shapes are drawn on it");
  return {.size_m = extent.head<2>()};
}

/// How many times as wide the band would have to be to hold the whole true outline. Between two
/// points of a level line both it and the score are linear, so its points are enough.
double needed_width(const Surface& surface, const Certainty& certainty, const World& world) {
  double greatest = 0.0;
  for (const LevelLoop& loop : level_loops(surface, world.truth, world.true_level)) {
    for (const SurfacePoint& point : loop.points)
      greatest = std::max(greatest, std::abs(surface.interpolate(certainty.score, point)));
  }
  return greatest / certainty.band_score;
}

double uniform(Random& random, double least, double most) {
  return least + (most - least) * random.uniform();
}

Run run_of(const Scene& base, const Surface& surface, std::uint64_t seed) {
  Run run{.seed = seed, .noise = base.number("probe.noise")};
  Random random(seed ^ kShapeStream);
  const ShapeFamily family = random.below(2) == 0 ? ShapeFamily::Star : ShapeFamily::Bent;
  run.family = family == ShapeFamily::Star ? "star" : "bent";
  run.slope_per_m = uniform(random, kLeastSlope_per_m, kMostSlope_per_m);
  const Outline outline = random_shape(family, random, shape_options(base, surface));
  run.area_m2 = signed_area(outline);
  const Vec3 origin = surface.mesh().vertices.colwise().minCoeff().transpose();
  const Scene scene =
      base.with("seed", seed)
          .with("probe.slope_per_m", run.slope_per_m)
          .with("probe.tumours",
                json::array({{{"shape", "polygon"}, {"points_mm", points_mm(outline, origin)}}}));
  const World world = simulated_world(scene, surface);
  const Episode episode = run_episode(scene, surface, world);
  const Exploration& exploration = episode.exploration;

  const ReferenceBound bound =
      reference_bound({.perimeter_m = perimeter(outline),
                       .slope_per_m = run.slope_per_m,
                       .noise = run.noise,
                       .readings = static_cast<int>(exploration.belief().palpations().size()),
                       .fraction = scene.number("level.fraction")});
  run.bound_m2 = bound.expected_error_m2;
  run.bound_half_width_m = bound.band_half_width_m(scene.number("band.probability"));
  run.error_m2 = episode.error ? episode.error->symmetric_difference_m2 : run.area_m2;
  run.lost = run.error_m2 > 0.5 * run.area_m2;
  run.warnings = boundary_remarks(episode).size();
  run.found = !episode.estimate.empty() && exploration.level().has_value();
  if (!run.found) return run;
  const Certainty& certainty = *exploration.certainty();
  run.needed_width = needed_width(surface, certainty, world);
  run.covered = run.needed_width <= 1.0;
  run.half_width_m = certainty.half_width_m;
  run.expected_m2 = certainty.expected.symmetric_difference_m2();
  return run;
}

std::string csv_of(const std::vector<Run>& runs) {
  std::string csv =
      "seed,noise,family,area_mm2,slope_per_m,error_mm2,bound_mm2,found,lost,covered,half_width_mm,"
      "bound_half_width_mm,expected_error_mm2,"
      "needed_width,warnings\n";
  const auto flag = [](bool value) { return std::string(value ? "1" : "0"); };
  for (const Run& run : runs) {
    csv += std::to_string(run.seed) + "," + text_of(run.noise) + "," + run.family + "," +
           text_of(run.area_m2 * 1e6) + "," + text_of(run.slope_per_m) + "," +
           text_of(run.error_m2 * 1e6) + "," + text_of(run.bound_m2 * 1e6) + "," + flag(run.found) +
           "," + flag(run.lost) + "," + flag(run.covered) + "," + text_of(run.half_width_m * 1e3) +
           "," + text_of(run.bound_half_width_m * 1e3) + "," + text_of(run.expected_m2 * 1e6) +
           "," + text_of(run.needed_width) + "," + std::to_string(run.warnings) + "\n";
  }
  return csv;
}

/// One line of the report, over some of the runs. Widths and expectations are of the runs where
/// something was found.
void report_row(const std::string& name, const std::vector<Run>& runs) {
  double error_ratio = 0.0, worst = 0.0, width = 0.0, bound_width = 0.0;
  int lost = 0, covered = 0, above_five = 0, unforeseen = 0;
  std::vector<double> true_over_expected;
  for (const Run& run : runs) {
    const double ratio = run.error_m2 / run.bound_m2;
    error_ratio += ratio / static_cast<double>(runs.size());
    worst = std::max(worst, ratio);
    above_five += ratio > 5.0 && run.warnings == 0;
    lost += run.lost;
    covered += run.covered;
    if (!run.found) continue;
    width += run.half_width_m;
    bound_width += run.bound_half_width_m;
    true_over_expected.push_back(run.error_m2 / run.expected_m2);
    unforeseen += true_over_expected.back() > 2.0;
  }
  const double share = 100.0 / static_cast<double>(runs.size());
  std::printf("%-12s%6zu%10.2f%8.1f%8d%6d%11.1f%10.2f%12.2f%10.1f\n", name.c_str(), runs.size(),
              error_ratio, worst, above_five, lost, share * covered, width / bound_width,
              median(true_over_expected), share * unforeseen);
}

void report(const std::vector<Run>& runs, double probability,
            const ExperimentArguments& arguments) {
  std::printf(
      "\nTumours of random shape, area and slope, unknown to the method; %d per noise\n"
      "            runs  error / bound    above 5  lost  covered %%  width /   true / expected "
      "error\n"
      "                   mean   worst  unsaid              (%3.0f)  bound's     median  above 2 "
      "%%\n",
      arguments.trials, 100.0 * probability);
  for (const double noise : kNoises) {
    std::vector<Run> some;
    std::copy_if(runs.begin(), runs.end(), std::back_inserter(some),
                 [&](const Run& run) { return run.noise == noise; });
    report_row("noise " + fixed(100.0 * noise, 0) + " %", some);
  }
  report_row("all", runs);
}

}  // namespace

json random_tumours_scene() {
  return {{"version", 1},
          {"surface", {{"plane", {{"size_mm", {54, 49}}, {"vertices", {109, 99}}}}}},
          {"probe", {{"kind", "simulated"}, {"low", 7}, {"high", 9}, {"tumours", json::array()}}}};
}

void coverage(const ExperimentArguments& arguments) {
  const Scene base = base_scene(arguments, random_tumours_scene());
  std::vector<Cell> cells;
  for (const double noise : kNoises)
    cells.push_back({"noise " + fixed(100.0 * noise, 0) + " %", base.with("probe.noise", noise)});
  if (printed_scenes(cells, arguments)) return;
  const Tissue tissue = tissue_of(base);
  std::vector<Run> runs(cells.size() * static_cast<std::size_t>(arguments.trials));
  for_trials(cells.size(), arguments, [&](std::size_t cell, std::size_t trial, std::uint64_t seed) {
    runs[cell * static_cast<std::size_t>(arguments.trials) + trial] =
        run_of(cells[cell].scene, tissue.surface, seed);
  });
  report(runs, base.number("band.probability"), arguments);
  write_table(arguments, "coverage", csv_of(runs));
}

}  // namespace palpation::tool
