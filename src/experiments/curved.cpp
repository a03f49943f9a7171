// experiment curved: tumours on curved tissue, by each metric of the field; which to choose, and
// what it costs.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>

#include "experiments/experiment.h"
#include "experiments/paper_scene.h"
#include "palpation/base/error.h"
#include "palpation/geometry/make_phantom.h"
#include "palpation/geometry/make_plane.h"
#include "scene/draw_program.h"
#include "scene/mesh_words.h"
#include "scene/setup.h"
#include "scene/stopwatch.h"
#include "scene/words.h"
#include "scene/worlds.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

constexpr double kEdge_m = 0.0006;
constexpr double kJitter = 0.3;
constexpr double kMm2 = 1e6;

const std::vector<std::string> kMetrics = {"chart", "ambient", "intrinsic"};

/// A phantom, and where the paper's tumours lie on it.
struct Sheeted {
  std::string name;
  std::function<TriangleMesh()> mesh;
  Vec3 disk_mm, horseshoe_mm;  ///< their centres
};

TriangleMesh mesh_of(const Sheet& sheet) {
  Random random(1);
  return make_phantom(sheet, kEdge_m, kJitter, random).mesh;
}

TriangleMesh flat_mesh() {
  Random random(1);
  const Vec2 size(0.025, 0.050);
  return make_plane({.size_m = size,
                     .columns = static_cast<int>(size.x() / kEdge_m) + 1,
                     .rows = static_cast<int>(size.y() / kEdge_m) + 1,
                     .jitter = kJitter},
                    random);
}

Sheeted folded(double gap_mm) {
  return {"folded, gap " + fixed(gap_mm, 2) + " mm",
          [gap_mm] { return mesh_of(folded_sheet({.gap_m = gap_mm / 1e3})); },
          {10.5, 12.5, 0.0},
          {6.5, 12.5, 0.0}};
}

std::vector<Sheeted> tissues() {
  return {
      {"plane", flat_mesh, {11.492, 30.0, 0.0}, {9.492, 20.0, 0.0}},
      {"cylinder",
       [] { return mesh_of(cylinder_sheet()); },
       {11.492, 30.0, 0.0},
       {9.492, 20.0, -0.305}},
      {"dome", [] { return mesh_of(dome_sheet()); }, {3.0, 4.0, -0.505}, {-3.5, 0.0, -0.246}},
      {"saddle", [] { return mesh_of(saddle_sheet()); }, {-1.0, 5.0, -0.48}, {-3.0, -5.0, -0.32}},
      {"wave", [] { return mesh_of(wave_sheet()); }, {11.492, 30.0, 0.0}, {9.492, 20.0, 0.0}},
      folded(3.0),
      folded(1.5),
      folded(0.75)};
}

json tumour_at(const std::string& shape, const Vec3& centre_mm) {
  json tumours = paper_tumour(shape);
  tumours[0]["centre_mm"] = {centre_mm.x(), centre_mm.y(), centre_mm.z()};
  return tumours;
}

/// The tool's defaults; the mesh is the experiment's own.
json curved_scene() {
  json scene = default_scene();
  scene["surface"] = {{"mesh", "made by the experiment"}, {"unit", "mm"}};
  scene["plan"]["initial"] = {{"design", "grid"}, {"count", 15}};
  scene["plan"]["batches"] = 9;
  scene["probe"]["noise"] = 0.05;
  return scene;
}

/// One line of the table.
struct Row {
  std::size_t tissue = 0;
  std::string shape, metric;
  Scene scene;
};

struct Outcome {
  double error_m2 = 0.0;
  std::optional<double> mean_distance_m{};
  std::vector<double> errors_m2{};  ///< after every batch
  double batch_s = 0.0;             ///< the median
};

/// From a mesh to the first prior of the metric, chart or spectrum included.
double seconds_to_prepare(const TriangleMesh& mesh, const Scene& scene) {
  const Surface fresh(mesh);
  const FieldModel field = field_of(scene);
  const Stopwatch watch;
  const LengthRange lengths = field.kernel.length_m.is_learned()
                                  ? lengths_to_learn(field.kernel.length_median_m)
                                  : LengthRange{};
  Kernel kernel = kernel_of(field.kernel);
  kernel.length_m = field.kernel.length_median_m;
  const Prior prior(fresh, field.metric, kernel, field.trend.constant, {}, lengths);
  return watch.seconds();
}

Outcome outcome_of(const Scene& scene, const Surface& surface) {
  const Episode episode = run_episode(scene, surface, simulated_world(scene, surface));
  Outcome outcome;
  for (const TraceRow& row : episode.trace)
    outcome.errors_m2.push_back(row.error ? row.error->symmetric_difference_m2 : surface.area());
  outcome.error_m2 = outcome.errors_m2.back();
  if (episode.error) outcome.mean_distance_m = episode.error->mean_distance_m;
  outcome.batch_s = median(episode.batch_seconds);
  return outcome;
}

std::vector<double> errors_of(const std::vector<Outcome>& trials) {
  std::vector<double> values;
  for (const Outcome& trial : trials) values.push_back(trial.error_m2 * kMm2);
  return values;
}

std::vector<double> distances_of(const std::vector<Outcome>& trials) {
  std::vector<double> values;
  for (const Outcome& trial : trials) {
    if (trial.mean_distance_m) values.push_back(*trial.mean_distance_m * 1e3);
  }
  return values;
}

std::vector<double> batches_of(const std::vector<Outcome>& trials) {
  std::vector<double> values;
  for (const Outcome& trial : trials) values.push_back(trial.batch_s);
  return values;
}

/// How the error falls on one tissue, a curve per metric.
void draw(const ExperimentArguments& arguments, const std::string& tissue,
          const std::vector<Row>& rows, std::size_t first,
          const std::vector<std::vector<Outcome>>& outcomes) {
  std::string csv = "readings";
  for (const std::string& metric : kMetrics) csv += "," + metric + "," + metric + "_se";
  csv += "\n";
  const int initial = rows[first].scene.integer("plan.initial.count"),
            batch = rows[first].scene.integer("plan.batch");
  for (std::size_t step = 0; step < outcomes[first].front().errors_m2.size(); ++step) {
    csv += std::to_string(initial + batch * static_cast<int>(step));
    for (std::size_t metric = 0; metric < kMetrics.size(); ++metric) {
      std::vector<double> values;
      for (const Outcome& trial : outcomes[first + metric])
        values.push_back(trial.errors_m2[std::min(step, trial.errors_m2.size() - 1)] * kMm2);
      const Statistics result = statistics(values);
      csv += "," + text_of(result.mean) + "," + or_empty(result.standard_error);
    }
    csv += "\n";
  }
  std::string name = "curved_" + tissue;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == ' ' || c == ','; }, '_');
  write_table(arguments, name, csv);
  const auto no_picture = run_draw({"--curves", (arguments.out / (name + ".csv")).string(),
                                    (arguments.out / (name + ".png")).string(), "--log-y",
                                    "--title", tissue + ", disk, noise 5 %", "--x-label",
                                    "readings", "--y-label", "wrong area on the tissue, mm2"});
  if (no_picture) std::fprintf(stderr, "palpate: no picture: %s\n", no_picture->c_str());
}

}  // namespace

void curved(const ExperimentArguments& arguments) {
  const Scene base = base_scene(arguments, curved_scene());
  const std::vector<Sheeted> all = tissues();
  std::vector<Row> rows;
  std::vector<Cell> cells;
  for (std::size_t tissue = 0; tissue < all.size(); ++tissue) {
    for (const std::string& shape : kPaperShapes) {
      for (const std::string& metric : kMetrics) {
        const std::string name = all[tissue].name + ", " + shape + ", " + metric;
        if (!is_chosen(name, arguments)) continue;
        const Vec3 centre_mm = shape == "disk" ? all[tissue].disk_mm : all[tissue].horseshoe_mm;
        const Scene scene =
            base.with("field.metric", metric).with("probe.tumours", tumour_at(shape, centre_mm));
        rows.push_back({tissue, shape, metric, scene});
        cells.push_back({name, scene});
      }
    }
  }
  refuse_no_cell(cells.size(), arguments);
  if (printed_scenes(cells, arguments)) return;

  std::vector<TriangleMesh> meshes;
  std::vector<Surface> surfaces;
  for (const Sheeted& tissue : all) {
    meshes.push_back(tissue.mesh());
    surfaces.emplace_back(meshes.back());
  }
  std::vector<std::vector<Outcome>> outcomes(
      rows.size(), std::vector<Outcome>(static_cast<std::size_t>(arguments.trials)));
  for_trials(rows.size(), arguments, [&](std::size_t row, std::size_t trial, std::uint64_t seed) {
    outcomes[row][trial] =
        outcome_of(rows[row].scene.with("seed", seed), surfaces[rows[row].tissue]);
  });

  std::printf(
      "\nWrong area on the tissue after %d readings, noise 5 %%: mean +- standard error of %d "
      "trials\n",
      base.integer("plan.initial.count") +
          base.integer("plan.batch") * base.integer("plan.batches"),
      arguments.trials);
  std::printf("%-20s%-11s%-11s%16s%10s%10s%10s%10s   %s\n", "tissue", "shape", "metric", "mm2",
              "of flat", "mm apart", "ready s", "batch s", "laid flat");
  std::string csv =
      "tissue,shape,metric,trials,error_mm2,standard_error,of_flat,mean_distance_mm,prepare_s,"
      "batch_s,least_stretch,greatest_stretch\n";
  std::array<std::optional<double>, 2> flat{};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    const std::size_t shape = row.shape == kPaperShapes[0] ? 0 : 1;
    const Statistics error = statistics(errors_of(outcomes[i]));
    if (row.tissue == 0 && row.metric == "chart") flat[shape] = error.mean;
    const std::optional<double> of_flat =
        flat[shape] ? std::optional(error.mean / *flat[shape]) : std::nullopt;
    const double distance = statistics(distances_of(outcomes[i])).mean,
                 batch_s = median(batches_of(outcomes[i]));
    const double prepare_s = seconds_to_prepare(meshes[row.tissue], row.scene);
    const Distortion& distortion = surfaces[row.tissue].chart().distortion;
    std::printf("%-20s%-11s%-11s%s%10s%10.3f%10.2f%10.3f   %s\n", all[row.tissue].name.c_str(),
                row.shape.c_str(), row.metric.c_str(), in_words(error).c_str(),
                or_dash(of_flat).c_str(), distance, prepare_s, batch_s,
                row.metric == "chart" ? stretch_words(distortion).c_str() : "");
    csv += "\"" + all[row.tissue].name + "\"," + row.shape + "," + row.metric + "," +
           std::to_string(arguments.trials) + "," + text_of(error.mean) + "," +
           or_empty(error.standard_error) + "," + or_empty(of_flat) + "," + text_of(distance) +
           "," + text_of(prepare_s) + "," + text_of(batch_s) + "," +
           text_of(distortion.least_stretch) + "," + text_of(distortion.greatest_stretch) + "\n";
  }
  write_table(arguments, "curved", csv);
  if (arguments.out.empty() || !arguments.only.empty()) return;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].shape == kPaperShapes[0] && rows[i].metric == kMetrics[0])
      draw(arguments, all[rows[i].tissue].name, rows, i, outcomes);
  }
}

}  // namespace palpation::tool
