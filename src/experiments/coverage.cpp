// experiment coverage: whether the band holds the outline as often as it says, over tumours of any
// shape that the method knows nothing of.
#include "experiments/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "experiments/experiment.h"
#include "experiments/lazy_tissue.h"
#include "palpation/base/error.h"
#include "palpation/certainty/certainty.h"
#include "palpation/certainty/reference_bound.h"
#include "palpation/world/random_shape.h"
#include "scene/remarks.h"
#include "scene/words.h"
#include "scene/worlds.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

constexpr std::uint64_t kShapeStream = 0x7368617065u;
constexpr double kLeastSlope_per_m = 500.0, kMostSlope_per_m = 2000.0;
constexpr std::array kNoises = {0.01, 0.05, 0.10, 0.25};

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
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      // The tissue's border is no outline.
      if (loop.on_border[i] && loop.on_border[(i + loop.points.size() - 1) % loop.points.size()])
        continue;
      greatest = std::max(greatest, std::abs(surface.interpolate(certainty.score, loop.points[i])));
    }
  }
  return greatest / certainty.band_score;
}

double uniform(Random& random, double least, double most) {
  return least + (most - least) * random.uniform();
}

/// A tumour that the method knows nothing of.
struct Drawn {
  std::string family;
  double slope_per_m = 0.0;
  Outline outline;
};

Drawn drawn(const Scene& base, const Surface& surface, std::uint64_t seed) {
  Random random(seed ^ kShapeStream);
  const ShapeFamily family = random.below(2) == 0 ? ShapeFamily::Star : ShapeFamily::Bent;
  const double slope_per_m = uniform(random, kLeastSlope_per_m, kMostSlope_per_m);
  return {family == ShapeFamily::Star ? "star" : "bent", slope_per_m,
          random_shape(family, random, shape_options(base, surface))};
}

Figures run_of(const Scene& base, const Surface& surface, std::uint64_t seed) {
  const Drawn tumour = drawn(base, surface, seed);
  const double area_m2 = signed_area(tumour.outline);
  const Vec3 origin = surface.mesh().vertices.colwise().minCoeff().transpose();
  const Scene scene =
      base.with("seed", seed)
          .with("probe.slope_per_m", tumour.slope_per_m)
          .with("probe.tumours", json::array({{{"shape", "polygon"},
                                               {"points_mm", points_mm(tumour.outline, origin)}}}));
  const World world = simulated_world(scene, surface);
  const Episode episode = run_episode(scene, surface, world);
  const Exploration& exploration = episode.exploration;
  const ReferenceBound bound = reference_bound(
      {.perimeter_m = perimeter(tumour.outline),
       .slope_per_m = tumour.slope_per_m,
       .noise = scene.number("probe.noise"),
       .readings = static_cast<int>(exploration.conclusion().belief.palpations().size()),
       .fraction = scene.number("level.fraction")});
  Figures row = against_truth(episode, world);
  row.set("family", tumour.family)
      .set("area_mm2", area_m2 * 1e6)
      .set("slope_per_m", tumour.slope_per_m)
      .set("bound_mm2", bound.expected_error_m2 * 1e6)
      .set("bound_half_width_mm", bound.band_half_width_m(scene.number("band.probability")) * 1e3);
  return row;
}

std::string share_text(int count, std::size_t of) {
  const Interval interval = wilson_interval(count, static_cast<int>(of));
  return text_of(static_cast<double>(count) / static_cast<double>(of)) + "," +
         text_of(interval.low) + "," + text_of(interval.high);
}

/// One line of the report, over some of the runs. Widths and expectations are of the runs where
/// something was found. Returns its line of the table.
std::string report_row(const std::string& name, const std::vector<Figures>& runs) {
  double worst = 0.0, width = 0.0, bound_width = 0.0;
  int lost = 0, covered = 0, above_five = 0, unforeseen = 0;
  std::vector<double> ratios, true_over_expected;
  for (const Figures& run : runs) {
    ratios.push_back(run.number("error_mm2") / run.number("bound_mm2"));
    worst = std::max(worst, ratios.back());
    above_five += ratios.back() > 5.0 && run.number("warnings") == 0.0;
    lost += run.flag("lost");
    covered += run.flag("covered");
    if (!run.flag("found")) continue;
    width += run.number("half_width_mm");
    bound_width += run.number("bound_half_width_mm");
    true_over_expected.push_back(run.number("error_mm2") / run.number("expected_error_mm2"));
    unforeseen += true_over_expected.back() > 2.0;
  }
  const Statistics ratio = statistics(ratios);
  const double share = 100.0 / static_cast<double>(runs.size());
  std::printf("%-12s%6zu%10.2f%8.1f%8d%6d%11.1f%10.2f%12.2f%10.1f\n", name.c_str(), runs.size(),
              ratio.mean, worst, above_five, lost, share * covered, width / bound_width,
              median(true_over_expected), share * unforeseen);
  return name + "," + std::to_string(runs.size()) + "," + csv_of(ratio) + "," + text_of(worst) +
         "," + share_text(lost, runs.size()) + "," + share_text(covered, runs.size()) + "," +
         text_of(width / bound_width) + "," + text_of(median(true_over_expected)) + "," +
         share_text(unforeseen, runs.size()) + "\n";
}

}  // namespace

std::vector<std::string> columns_against_truth() {
  return {"error_mm2",    "found",         "lost",     "covered",
          "needed_width", "half_width_mm", "warnings", "expected_error_mm2"};
}

void refuse_without_certainty(const Scene& scene) {
  if (scene.word("certainty") == "off")
    scene.refuse_value("certainty", "sampled or laplace, for experiment coverage to judge it");
}

Figures against_truth(const Episode& episode, const World& world) {
  const Exploration& exploration = episode.exploration;
  const Surface& surface = exploration.surface();
  const double area_m2 = episode.truth ? episode.truth->area() : 0.0;
  const double error_m2 = episode.error ? episode.error->symmetric_difference_m2 : area_m2;
  const bool found = !episode.estimate.empty() && exploration.conclusion().level.has_value();
  Figures row;
  row.set("error_mm2", error_m2 * 1e6)
      .set("found", found)
      .set("lost", area_m2 > 0.0 && error_m2 > 0.5 * area_m2)
      .set("covered", false)
      .set("warnings", static_cast<double>(boundary_remarks(episode).size()));
  if (!found) return row;
  const Certainty& certainty = *exploration.conclusion().certainty;
  const double needed = needed_width(surface, certainty, world);
  return row.set("covered", needed <= 1.0)
      .set("needed_width", needed)
      .set("half_width_mm", certainty.half_width_m * 1e3)
      .set("expected_error_mm2", certainty.expected.symmetric_difference_m2() * 1e6);
}

json random_tumours_scene() {
  return {{"version", 1},
          {"surface", {{"plane", {{"size_mm", {54, 49}}, {"vertices", {109, 99}}}}}},
          {"probe", {{"kind", "simulated"}, {"low", 7}, {"high", 9}, {"tumours", json::array()}}}};
}

Study coverage_study(const ExperimentArguments& arguments) {
  if (!arguments.material.world.empty()) return worlds_study(arguments);
  const Scene base = base_scene(arguments, random_tumours_scene());
  refuse_without_certainty(base);
  Study study;
  for (const double noise : kNoises)
    study.cells.push_back({"noise " + fixed(100.0 * noise, 0) + " %",
                           base.with("probe.noise", noise), Figures().set("noise", noise)});
  study.columns = {"noise",
                   "family",
                   "area_mm2",
                   "slope_per_m",
                   "error_mm2",
                   "bound_mm2",
                   "found",
                   "lost",
                   "covered",
                   "needed_width",
                   "half_width_mm",
                   "bound_half_width_mm",
                   "expected_error_mm2",
                   "warnings"};
  study.facts = {{"band.probability", text_of(base.number("band.probability"))}};
  const LazyTissue tissue(base);
  study.mesh_digest = [tissue](std::size_t) { return tissue.mesh_digest(); };
  study.run = [tissue, cells = study.cells](std::size_t cell, std::uint64_t seed) {
    return std::vector{run_of(cells[cell].scene, tissue.surface(), seed)};
  };
  return study;
}

void report_coverage(const Results& results, const ReportFolder& folder) {
  if (results.manifest.facts.contains("worlds")) return report_worlds(results, folder);
  std::printf(
      "\nTumours of random shape, area and slope, unknown to the method; %d per noise\n"
      "            runs  error / bound    above 5  lost  covered %%  width /   true / expected "
      "error\n"
      "                   mean   worst  unsaid              (%3.0f)  bound's     median  above 2 "
      "%%\n",
      results.trials(), 100.0 * std::stod(results.manifest.facts.at("band.probability")));
  std::string csv = std::string("noise,runs,error_over_bound,") + kStatisticsColumns +
                    ",worst,lost,lost_low_95,lost_high_95,covered,covered_low_95,covered_high_95,"
                    "width_over_bound,true_over_expected,above_two,above_two_low_95,"
                    "above_two_high_95\n";
  std::vector<Figures> all;
  for (std::size_t cell = 0; cell < results.manifest.cells.size(); ++cell) {
    const std::vector<Figures> runs = results.of(cell);
    csv += report_row(results.manifest.cells[cell].name, runs);
    all.insert(all.end(), runs.begin(), runs.end());
  }
  csv += report_row("all", all);
  folder.write("coverage", csv);
}

}  // namespace palpation::tool
