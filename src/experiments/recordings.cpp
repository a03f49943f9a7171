// experiment recordings: the physical recordings of Garg et al. 2016's probe, for those who have
// them. R1 to R7, each against its bound.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "experiments/recorded.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "palpation/io/csv.h"
#include "palpation/io/recording.h"
#include "palpation/world/recording.h"
#include "palpation/world/tumour.h"
#include "scene/digest.h"
#include "scene/setup.h"
#include "scene/words.h"
#include "scene/worlds.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

constexpr double kTipRadius_mm = 2.25;  // of the probe

/// What all recordings are explored with.
json replay_scene() {
  return {{"version", 1},
          {"surface",
           {{"plane",
             {{"size_mm", {25, 50}},
              {"vertices", {2, 2}}}}}},      // stands in for the mesh around each recording
          {"field", {{"trend", "linear"}}},  // no phantom lay quite level under the arm
          {"level", {{"estimate", "edge"}, {"fraction", 0.7}}},
          {"plan",
           {{"acquisition", "straddle"},
            {"initial", {{"design", "grid"}, {"count", 20}}},
            {"batch", 10},
            {"batches", 18}}},
          {"seed", 1}};
}

double error_at(const Episode& episode, const Surface& surface, int measurements) {
  for (const TraceRow& row : episode.trace) {
    if (row.measurements >= measurements)
      return row.error ? row.error->symmetric_difference_m2 * kCm2 : surface.area() * kCm2;
  }
  return surface.area() * kCm2;
}

Episode replayed(const ExperimentArguments& arguments, const Scene& scene, const Surface& surface,
                 const std::vector<std::string>& names) {
  std::vector<std::filesystem::path> paths;
  for (const std::string& name : names) paths.push_back(file_of(arguments, name));
  return run_episode(scene, surface, recorded_world(scene, surface, paths));
}

/// R1: a recording against its own map.
void own_map(const ExperimentArguments& arguments, const Scene& scene,
             std::vector<Figure>& figures) {
  const Surface tissue = recorded(arguments, "fig_circle_forward").tissue;
  const Episode episode = replayed(arguments, scene, tissue, {"fig_circle_forward"});
  figures.push_back({"R1", "circle against its own map at 100 readings, cm2",
                     error_at(episode, tissue, 100), 0.0, 0.40});
  figures.push_back({"R1", "the same at 200 readings", error_at(episode, tissue, 200), 0.0, 0.15});
  const RecordedWorld world(tissue, {read_recording(file_of(arguments, "fig_circle_forward"))});
  const double low = world.quantile(0.02), high = world.quantile(0.98);
  const Episode known =
      replayed(arguments,
               scene.with("level.estimate", "known")
                   .with("level.value", low + scene.number("level.fraction") * (high - low)),
               tissue, {"fig_circle_forward"});
  figures.push_back(
      {"R1", "the same, the map's level known", error_at(known, tissue, 200), 0.0, 0.15});
}

/// The least symmetric difference from a disk whose centre may be off by a registration error.
double error_to_disk(const Surface& surface, const Region& region, const Vec3& centre,
                     double radius_m, double off_m) {
  constexpr double kStep_m = 0.0001;
  double best = surface.area();
  const int steps = static_cast<int>(std::floor(off_m / kStep_m));
  for (int i = -steps; i <= steps; ++i) {
    for (int j = -steps; j <= steps; ++j) {
      const Vec3 shift(i * kStep_m, j * kStep_m, 0.0);
      if (shift.norm() > off_m) continue;
      const std::vector<Tumour> disk = {Disk{.centre_m = centre + shift, .radius_m = radius_m}};
      best = std::min(best, compare(surface, region,
                                    superlevel_region(surface, signed_distance(surface, disk), 0.0))
                                .symmetric_difference_m2);
    }
  }
  return best * kCm2;
}

/// R2: both directions of travel against the tumour itself; R3: what lag they tell.
void truth_and_lag(const ExperimentArguments& arguments, const Scene& scene,
                   std::vector<Figure>& figures) {
  const double radius_m = std::sqrt(1.84e-4 / std::numbers::pi);
  const std::vector<std::string> both = {"fig_circle_forward", "fig_circle_backward"};
  const Recorded forward = recorded(arguments, both[0]), backward = recorded(arguments, both[1]);
  const Scene probe = scene.with("field.lag_mm", "learn")
                          .with("field.indenter_radius_mm", kTipRadius_mm)
                          .with("level.fraction", 0.5);
  const Episode episode = replayed(arguments, probe, forward.tissue, both);
  figures.push_back(
      {"R2", "circle, both directions, against its disk of 1.84 cm2, cm2",
       error_to_disk(forward.tissue, episode.estimate, Vec3(0.0018, 0.0118, 0.0), radius_m, 0.0007),
       0.0, 0.35});
  const auto lag_mm = [&](double shift_m) {
    std::vector<Palpation> all;
    for (const Recorded* one : {&forward, &backward}) {
      for (std::size_t i = 0; i < one->places.size(); ++i) {
        Palpation palpation = one->palpations[i];
        const Vec3 place = one->places[i] + shift_m * palpation.travel;
        palpation.where = forward.tissue.project(place);
        if ((forward.tissue.position(palpation.where) - place).norm() < 1e-6)
          all.push_back(palpation);
      }
    }
    Exploration exploration(forward.tissue, model_of(probe), plan_of(probe));
    exploration.take_up(thinned(all));
    return exploration.conclusion().lag->value_m * 1e3;
  };
  const double here_mm = lag_mm(0.0);
  figures.push_back({"R3", "lags of the two directions, added up, mm", 2.0 * here_mm, 2.5, 3.2});
  for (const double shift_mm : {-1.0, 1.0}) {
    figures.push_back({"R3", "lag found less lag shifted by " + fixed(shift_mm, 0) + " mm, mm",
                       lag_mm(shift_mm / 1e3) - here_mm - shift_mm, -0.2, 0.2});
  }
}

/// R7: the edges of a strip from some of its pokes.
void pokes(const ExperimentArguments& arguments, const Scene& scene, std::vector<Figure>& figures) {
  const Surface tissue = recorded(arguments, "dense_grid").tissue;
  const Episode episode = replayed(
      arguments,
      scene.with("field.screening", true).with("level.fraction", 0.5).with("plan.batches", 8),
      tissue, {"dense_grid"});
  for (const double edge_m : {0.0135, 0.0329}) {
    double sum = 0.0;
    int count = 0;
    if (episode.exploration.conclusion().level) {
      const Contour& contour = *episode.exploration.conclusion().contour;
      for (const Vec3& point : points_of(tissue, contour.field, contour.level)) {
        if (std::abs(point.y() - edge_m) > 0.008) continue;
        sum += point.y() - edge_m;
        ++count;
      }
    }
    figures.push_back({"R7",
                       "edge at y = " + fixed(edge_m * 1e3, 1) + " mm from 100 pokes, off by, mm",
                       count > 0 ? 1e3 * sum / count : 1e3, -0.7, 0.7});
  }
}

void faults(const ExperimentArguments& arguments, const Scene&, std::vector<Figure>& figures) {
  add_faults(arguments, figures);
}

using Group = void (*)(const ExperimentArguments& arguments, const Scene& scene,
                       std::vector<Figure>& figures);

/// What is looked at by itself, and what the scene is changed to for it.
struct Groups {
  std::string name;
  Group figures;
  std::string path;
  json value;
};

const std::vector<Groups>& groups() {
  static const std::vector<Groups> all = {
      {"a map against itself", own_map, "field.trend", "constant"},  // it is of the whole field
      {"both directions of travel", truth_and_lag, "field.trend", "linear"},
      {"faults", faults, "field.trend", "linear"},
      {"fading contact", add_fading, "field.screening", true},
      {"pokes", pokes, "field.trend", "linear"}};
  return all;
}

/// Of all recordings in the folder.
std::string recordings_digest(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".csv") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::string digests;
  for (const std::filesystem::path& path : paths)
    digests += path.filename().string() + digest(read_file(path));
  return digest(digests);
}

}  // namespace

Study recordings_study(const ExperimentArguments& arguments) {
  const Scene scene = base_scene(arguments, replay_scene());
  Study study{.columns = {"goal", "what", "value", "least", "most", "good"}};
  for (const Groups& group : groups()) {
    const bool is_given =
        !arguments.scene.empty() && group.path == "field.trend" && group.value == "linear";
    study.cells.push_back({.name = group.name,
                           .scene = is_given ? scene : scene.with(group.path, group.value),
                           .trials = 1});
  }
  study.mesh_digest = [folder = arguments.material.recordings](std::size_t) {
    if (folder.empty())
      throw IoError(
          "experiment recordings: needs --recordings FOLDER, which holds fig_circle_forward.csv, "
          "exp4.csv and the others");
    return recordings_digest(folder);
  };
  study.run = [arguments, cells = study.cells](std::size_t cell, std::uint64_t) {
    std::vector<Figure> figures;
    groups()[cell].figures(arguments, cells[cell].scene, figures);
    std::vector<Figures> rows;
    for (const Figure& figure : figures)
      rows.push_back(Figures()
                         .set("goal", figure.name)
                         .set("what", figure.what)
                         .set("value", figure.value)
                         .set("least", figure.least)
                         .set("most", figure.most)
                         .set("good", figure.good()));
    return rows;
  };
  return study;
}

void report_recordings(const Results& results, const ReportFolder& folder) {
  std::string csv = "goal,what,value,least,most,good\n";
  for (const Row& row : results.rows) {
    const Figures& figure = row.figures;
    std::printf("%-3s %-66s %9.3f  [%g, %g]%s\n", figure.word("goal").c_str(),
                figure.word("what").c_str(), figure.number("value"), figure.number("least"),
                figure.number("most"), figure.flag("good") ? "" : "  MISSED");
    std::vector<std::string> cells;
    for (const char* column : {"goal", "what", "value", "least", "most", "good"})
      cells.push_back(figure.word(column));
    csv += csv_line(cells);
  }
  folder.write("recordings", csv);
}

}  // namespace palpation::tool
