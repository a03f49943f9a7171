// experiment curved: tumours on curved tissue, by each metric of the field; which to choose, and
// what it costs.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <mutex>

#include "experiments/experiment.h"
#include "experiments/paper_scene.h"
#include "palpation/base/error.h"
#include "palpation/geometry/make_phantom.h"
#include "palpation/geometry/make_plane.h"
#include "scene/digest.h"
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

/// A phantom and its surface, made when they are first asked for.
class LazySheet {
 public:
  explicit LazySheet(std::function<TriangleMesh()> make)
      : state_(std::make_shared<State>(std::move(make))) {}
  const TriangleMesh& mesh() const { return made().mesh; }
  const Surface& surface() const { return *made().surface; }

 private:
  struct State {
    explicit State(std::function<TriangleMesh()> how) : make(std::move(how)) {}
    std::function<TriangleMesh()> make;
    std::once_flag once;
    TriangleMesh mesh;
    std::optional<Surface> surface;
  };
  const State& made() const {
    std::call_once(state_->once, [&] {
      state_->mesh = state_->make();
      state_->surface.emplace(state_->mesh);
    });
    return *state_;
  }
  std::shared_ptr<State> state_;
};

Figures outcome_of(const Scene& scene, const Surface& surface) {
  const Episode episode = run_episode(scene, surface, simulated_world(scene, surface));
  std::vector<double> errors_mm2;
  for (const TraceRow& row : episode.trace)
    errors_mm2.push_back(kMm2 * (row.error ? row.error->symmetric_difference_m2 : surface.area()));
  Figures figures;
  figures.set("error_mm2", errors_mm2.back())
      .set("errors_mm2", list_text(errors_mm2))
      .set("batch_s", median(episode.seconds.batches));
  if (episode.error && episode.error->mean_distance_m)
    figures.set("mean_distance_mm", *episode.error->mean_distance_m * 1e3);
  return figures;
}

/// What the metric takes before the first touch, and what the chart does to the tissue.
Figures preparation_of(const Scene& scene, const LazySheet& sheet) {
  const Distortion& distortion = sheet.surface().chart().distortion;
  return Figures()
      .set("prepare_s", seconds_to_prepare(sheet.mesh(), scene))
      .set("least_stretch", distortion.least_stretch)
      .set("greatest_stretch", distortion.greatest_stretch)
      .set("stretch_words", stretch_words(distortion));
}

/// How the error falls on one tissue, a curve per metric.
void draw(const std::string& tissue, const std::vector<std::vector<Figures>>& curves,
          const ReportFolder& folder) {
  std::string csv = "readings";
  for (const std::string& metric : kMetrics) csv += "," + metric + "," + metric + "_se";
  csv += "\n";
  const Figures& first = curves.front().front();
  const std::size_t steps = listed(first, "errors_mm2").size();
  for (std::size_t step = 0; step < steps; ++step) {
    csv += text_of(first.number("initial") + first.number("batch") * static_cast<double>(step));
    for (const std::vector<Figures>& trials : curves) {
      std::vector<double> values;
      for (const Figures& trial : trials) {
        const std::vector<double> errors = listed(trial, "errors_mm2");
        values.push_back(errors[std::min(step, errors.size() - 1)]);
      }
      const Statistics result = statistics(values);
      csv += "," + text_of(result.mean) + "," + or_empty(result.standard_error);
    }
    csv += "\n";
  }
  std::string name = "curved_" + tissue;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == ' ' || c == ','; }, '_');
  folder.write(name, csv);
  folder.draw(name, {"--log-y", "--title", tissue + ", disk, noise 5 %", "--x-label", "readings",
                     "--y-label", "wrong area on the tissue, mm2"});
}

/// Curves of the disk, of each tissue that has them for all metrics.
void draw_all(const Results& results, const ReportFolder& folder) {
  std::map<std::string, std::vector<std::vector<Figures>>> by_tissue;
  for (std::size_t cell = 0; cell < results.manifest.cells.size(); ++cell) {
    const std::vector<Figures> trials = results.of(cell);
    if (trials.front().has("error_mm2") && trials.front().word("error_mm2") != "" &&
        trials.front().word("shape") == kPaperShapes[0])
      by_tissue[trials.front().word("tissue")].push_back(trials);
  }
  for (const auto& [tissue, curves] : by_tissue) {
    if (curves.size() == kMetrics.size()) draw(tissue, curves, folder);
  }
}

constexpr const char* kPreparing = "before the first touch: ";

}  // namespace

Study curved_study(const ExperimentArguments& arguments) {
  const Scene base = base_scene(arguments, curved_scene());
  const std::vector<Sheeted> all = tissues();
  Study study;
  std::vector<std::size_t> tissue_of_cell;
  for (std::size_t tissue = 0; tissue < all.size(); ++tissue) {
    for (const std::string& shape : kPaperShapes) {
      for (const std::string& metric : kMetrics) {
        const std::string name = all[tissue].name + ", " + shape + ", " + metric;
        if (!is_chosen(name, arguments)) continue;
        const Vec3 centre_mm = shape == "disk" ? all[tissue].disk_mm : all[tissue].horseshoe_mm;
        const Scene scene =
            base.with("field.metric", metric).with("probe.tumours", tumour_at(shape, centre_mm));
        const Figures labels = Figures()
                                   .set("tissue", all[tissue].name)
                                   .set("shape", shape)
                                   .set("metric", metric)
                                   .set("initial", scene.number("plan.initial.count"))
                                   .set("batch", scene.number("plan.batch"));
        study.cells.push_back({name, scene, labels});
        study.cells.push_back({kPreparing + name, scene, labels, 1, true});
        tissue_of_cell.insert(tissue_of_cell.end(), {tissue, tissue});
      }
    }
  }
  study.columns = label_columns(study.cells);
  study.columns.insert(study.columns.end(),
                       {"error_mm2", "errors_mm2", "mean_distance_mm", "batch_s", "prepare_s",
                        "least_stretch", "greatest_stretch", "stretch_words"});
  std::vector<LazySheet> sheets;
  for (const Sheeted& tissue : all) sheets.emplace_back(tissue.mesh);
  study.mesh_digest = [=](std::size_t cell) { return digest(sheets[tissue_of_cell[cell]].mesh()); };
  study.run = [=, cells = study.cells](std::size_t cell, std::uint64_t seed) {
    const LazySheet& sheet = sheets[tissue_of_cell[cell]];
    return std::vector{cells[cell].alone
                           ? preparation_of(cells[cell].scene, sheet)
                           : outcome_of(cells[cell].scene.with("seed", seed), sheet.surface())};
  };
  return study;
}

void report_curved(const Results& results, const ReportFolder& folder) {
  const Figures& any = results.rows.front().figures;
  const std::size_t batches = listed(any, "errors_mm2").size() - 1;
  std::printf(
      "\nWrong area on the tissue after %g readings, noise 5 %%: mean +- standard error of %d "
      "trials\n",
      any.number("initial") + any.number("batch") * static_cast<double>(batches), results.trials());
  std::printf("%-20s%-11s%-11s%16s%10s%10s%10s%10s   %s\n", "tissue", "shape", "metric", "mm2",
              "of flat", "mm apart", "ready s", "batch s", "laid flat");
  std::string csv = std::string("tissue,shape,metric,trials,error_mm2,") + kStatisticsColumns +
                    ",of_flat,mean_distance_mm,least_stretch,greatest_stretch\n";
  std::string times = "tissue,shape,metric,prepare_s,batch_s\n";
  std::map<std::string, double> flat;  // by shape
  for (std::size_t cell = 0; cell < results.manifest.cells.size(); cell += 2) {
    const std::vector<Figures> trials = results.of(cell);
    const Figures preparation = results.of(cell + 1).front();
    const std::string tissue = preparation.word("tissue"), shape = preparation.word("shape"),
                      metric = preparation.word("metric");
    const Statistics error = statistics(trials, "error_mm2");
    if (tissue == "plane" && metric == "chart") flat[shape] = error.mean;
    const std::optional<double> of_flat =
        flat.contains(shape) ? std::optional(error.mean / flat[shape]) : std::nullopt;
    const double distance = statistics(trials, "mean_distance_mm").mean;
    const double batch_s = median(values_of(trials, "batch_s"));
    std::printf("%-20s%-11s%-11s%s%10s%10.3f%10.2f%10.3f   %s\n", tissue.c_str(), shape.c_str(),
                metric.c_str(), in_words(error).c_str(), or_dash(of_flat).c_str(), distance,
                preparation.number("prepare_s"), batch_s,
                metric == "chart" ? preparation.word("stretch_words").c_str() : "");
    const std::string start = "\"" + tissue + "\"," + shape + "," + metric + ",";
    csv += start + std::to_string(trials.size()) + "," + csv_of(error) + "," + or_empty(of_flat) +
           "," + text_of(distance) + "," + preparation.word("least_stretch") + "," +
           preparation.word("greatest_stretch") + "\n";
    times += start + preparation.word("prepare_s") + "," + text_of(batch_s) + "\n";
  }
  folder.write("curved", csv);
  folder.write("curved_times", times);
  draw_all(results, folder);
}

}  // namespace palpation::tool
