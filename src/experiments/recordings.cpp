// experiment recordings: the physical recordings of Garg et al. 2016's probe, for those who have
// them. R1 to R7, each against its bound.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include "experiments/experiment.h"
#include "palpation/base/error.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/io/csv.h"
#include "palpation/io/recording.h"
#include "palpation/readings/screening.h"
#include "palpation/world/recording.h"
#include "palpation/world/tumour.h"
#include "readings/contact.h"
#include "scene/setup.h"
#include "scene/words.h"
#include "scene/worlds.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

constexpr double kCell_m =
    0.0007;  // of the mesh around a recording: half the distance of its closest rows
constexpr std::size_t kMostBelieved =
    300;  // of a dense recording's readings: more lie closer together than any edge is sharp
constexpr double kCm2 = 1e4;            // in a square metre
constexpr double kTipRadius_mm = 2.25;  // of the probe
constexpr double kFaultyShare = 0.1;    // of a row's readings: the row has a fault

/// One figure against its bound.
struct Figure {
  std::string name, what;
  double value = 0.0, least = 0.0, most = 0.0;
  bool good() const { return value >= least && value <= most; }
};

/// A recording as it was made: places, readings, scan lines.
struct Recorded {
  std::string name;
  Surface tissue;
  std::vector<Palpation> palpations;
  std::vector<int> index, row;
  std::vector<Vec3> places;
};

Surface tissue_around(std::span<const Vec3> places) {
  Vec2 least = places.front().head<2>(), most = least;
  for (const Vec3& place : places) {
    least = least.cwiseMin(place.head<2>());
    most = most.cwiseMax(place.head<2>());
  }
  const Vec2 size = most - least;
  Random unused(0);
  return Surface(make_plane({.size_m = size,
                             .columns = static_cast<int>(std::ceil(size.x() / kCell_m)) + 1,
                             .rows = static_cast<int>(std::ceil(size.y() / kCell_m)) + 1,
                             .corner_m = least},
                            unused));
}

std::filesystem::path file_of(const ExperimentArguments& arguments, const std::string& name) {
  return arguments.recordings / (name + ".csv");
}

/// Without heights: they are the arm's, not the tissue's. Rows that run one way along y have that
/// direction of travel.
Recorded recorded(const ExperimentArguments& arguments, const std::string& name) {
  const CsvTable table = read_csv(file_of(arguments, name));
  const std::size_t x = column_index(table, "x"), y = column_index(table, "y"),
                    reading = column_index(table, "reading"), row = column_index(table, "row"),
                    index = column_index(table, "index");
  std::vector<Vec3> places;
  std::vector<double> readings;
  std::vector<int> rows, indices;
  for (std::size_t i = 0; i < table.row_count(); ++i) {
    const std::optional<double> felt = number_at(table, i, reading);
    if (!felt || std::isnan(*felt)) continue;
    places.emplace_back(finite_number_at(table, i, x), finite_number_at(table, i, y), 0.0);
    readings.push_back(*felt);
    rows.push_back(static_cast<int>(finite_number_at(table, i, row)));
    indices.push_back(static_cast<int>(finite_number_at(table, i, index)));
  }
  if (places.empty()) throw IoError(table.name() + ": no row holds a reading");
  double forward_m = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (rows[i] == rows[i - 1]) forward_m += places[i].y() - places[i - 1].y();
  }
  Recorded made{name, tissue_around(places), {}, indices, rows, places};
  for (std::size_t i = 0; i < places.size(); ++i) {
    Palpation palpation;
    palpation.where = made.tissue.project(places[i]);
    palpation.reading = readings[i];
    palpation.travel = forward_m > 0.0 ? Vec3(Vec3::UnitY()) : Vec3(-Vec3::UnitY());
    made.palpations.push_back(palpation);
  }
  return made;
}

/// What is used of the readings, thinned evenly.
std::vector<Palpation> thinned(std::span<const Palpation> palpations, std::size_t most) {
  std::vector<Palpation> used;
  for (const Palpation& palpation : palpations) {
    if (palpation.set_aside.empty()) used.push_back(palpation);
  }
  const std::size_t stride = (used.size() + most - 1) / most;
  std::vector<Palpation> kept;
  for (std::size_t i = 0; i < used.size(); i += stride) kept.push_back(used[i]);
  return kept;
}

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
    exploration.take_up(thinned(all, kMostBelieved));
    return exploration.lag()->value_m * 1e3;
  };
  const double here_mm = lag_mm(0.0);
  figures.push_back({"R3", "lags of the two directions, added up, mm", 2.0 * here_mm, 2.5, 3.2});
  for (const double shift_mm : {-1.0, 1.0}) {
    figures.push_back({"R3", "lag found less lag shifted by " + fixed(shift_mm, 0) + " mm, mm",
                       lag_mm(shift_mm / 1e3) - here_mm - shift_mm, -0.2, 0.2});
  }
}

bool is_fault(const Palpation& palpation) {
  return !palpation.set_aside.empty() && palpation.set_aside != kStartUp;
}

/// What is known to be wrong with a recording: readings by their row, index and place along the
/// row.
struct KnownFault {
  std::string recording;
  std::function<bool(int row, int index, double y_m)> is_faulty;
};

/// R4: what the screen sets aside.
void screening(const ExperimentArguments& arguments, std::vector<Figure>& figures) {
  const std::vector<KnownFault> faults = {
      {"exp2", [](int row, int, double) { return row >= 3; }},
      {"exp3", [](int row, int, double y_m) { return row == 9 || (row == 0 && y_m < 0.005); }},
      {"exp5", [](int row, int, double y_m) { return row == 2 && y_m > 0.037; }},
      {"exp6", [](int row, int, double y_m) { return row == 0 || (row == 1 && y_m < 0.022); }},
      {"probe_data_L2R_old_tool_tilt_yaw90",
       [](int row, int, double y_m) { return row == 0 && y_m < 0.0235; }},
      {"point_probe_40x20x1",
       [](int, int index, double) { return index >= 667; }},  // the first of equal readings is none
      {"dense_grid",
       [](int, int index, double) {
         return index == 129 || index == 130 || index == 131 || index == 214;
       }},
  };
  for (const KnownFault& fault : faults) {
    const Recorded recording = recorded(arguments, fault.recording);
    const std::vector<Palpation> result = screened(recording.tissue, recording.palpations);
    int missed = 0;
    for (std::size_t i = 0; i < result.size(); ++i) {
      if (result[i].set_aside.empty() &&
          fault.is_faulty(recording.row[i], recording.index[i], recording.places[i].y()))
        ++missed;
    }
    figures.push_back({"R4", fault.recording + ": faulty readings not set aside",
                       static_cast<double>(missed), 0.0, 0.0});
  }
  for (const std::string name : {"exp4", "exp7", "exp9", "exp10"}) {
    const Recorded recording = recorded(arguments, name);
    const std::vector<Palpation> result = screened(recording.tissue, recording.palpations);
    std::vector<int> readings(100, 0), wrong(100, 0);
    for (std::size_t i = 0; i < result.size(); ++i) {
      const auto row = static_cast<std::size_t>(recording.row[i]) % readings.size();
      ++readings[row];
      if (is_fault(result[i])) ++wrong[row];
    }
    int rows = 0;
    for (std::size_t row = 0; row < readings.size(); ++row)
      rows += wrong[row] > kFaultyShare * readings[row] ? 1 : 0;
    figures.push_back({"R4", name + ": sound rows set aside", static_cast<double>(rows), 0.0, 1.0});
  }
}

/// What is believed of a dense recording, screened and thinned.
struct Believed {
  Recorded recording;
  std::vector<Palpation> screened_readings;
  Exploration exploration;
};

Believed believed(const ExperimentArguments& arguments, const Scene& scene,
                  const std::string& name) {
  Recorded recording = recorded(arguments, name);
  std::vector<Palpation> all = screened(recording.tissue, recording.palpations);
  Exploration exploration(recording.tissue, model_of(scene), plan_of(scene));
  exploration.take_up(thinned(all, kMostBelieved));
  return {std::move(recording), std::move(all), std::move(exploration)};
}

/// Points of a boundary, apart from the tissue's border.
std::vector<Vec3> points_of(const Surface& surface, const Field& field, double level) {
  std::vector<Vec3> points;
  for (const LevelLoop& loop : level_loops(surface, field, level)) {
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      if (!loop.on_border[i]) points.push_back(surface.position(loop.points[i]));
    }
  }
  return points;
}

/// Mean half width of the band on the side of the tissue where contact is better (false) or worse
/// (true).
double half_width_mm(const Believed& one, const FadingContact& fading, bool worse) {
  const Surface& tissue = one.recording.tissue;
  const Certainty& certainty = *one.exploration.certainty();
  const std::vector<Vec3> boundary = points_of(tissue, certainty.score, 0.0);
  std::vector<double> along;
  for (const Vec3& point : boundary) along.push_back(point.dot(fading.towards));
  if (along.empty()) return 0.0;
  std::nth_element(along.begin(), along.begin() + static_cast<std::ptrdiff_t>(along.size() / 2),
                   along.end());
  const double middle = along[along.size() / 2];
  double area = 0.0, length = 0.0;
  for (int vertex = 0; vertex < tissue.vertex_count(); ++vertex) {
    const bool is_there = (tissue.vertex(vertex).dot(fading.towards) > middle) == worse;
    if (is_there && std::abs(certainty.score[vertex]) <= certainty.band_score)
      area += tissue.vertex_areas()[vertex];
  }
  for (const LevelLoop& loop : level_loops(tissue, certainty.score, 0.0)) {
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      const Vec3 here = tissue.position(loop.points[i]),
                 next = tissue.position(loop.points[(i + 1) % loop.points.size()]);
      if (!loop.on_border[i] && (here.dot(fading.towards) > middle) == worse)
        length += (next - here).norm();
    }
  }
  return length > 0.0 ? 500.0 * area / length : 0.0;
}

/// R5: fading contact; R6: one recording's band against the boundary of another of the same rows.
void fading(const ExperimentArguments& arguments, const Scene& scene,
            std::vector<Figure>& figures) {
  std::optional<Believed> first;
  for (const std::string name : {"exp4", "exp7", "exp9", "exp10"}) {
    Believed now = believed(arguments, scene, name);
    const bool has_boundary =
        now.exploration.level() && now.exploration.certainty() &&
        !points_of(now.recording.tissue, now.exploration.certainty()->score, 0.0).empty();
    figures.push_back({"R5", name + ": boundaries found", has_boundary ? 1.0 : 0.0, 1.0, 1.0});
    const std::optional<FadingContact> contact =
        fading_contact(now.recording.tissue, now.screened_readings);
    figures.push_back(
        {"R5", name + ": warnings that contact fades", contact ? 1.0 : 0.0, 1.0, 1.0});
    if (contact && has_boundary) {
      const double ratio = half_width_mm(now, *contact, true) / half_width_mm(now, *contact, false);
      figures.push_back({"R5", name + ": band there over band elsewhere", ratio, 1.0, 1e3});
    }
    if (name == "exp4" && has_boundary) first = std::move(now);
    if (name != "exp7" || !first || !has_boundary) continue;
    const Surface& tissue = first->recording.tissue;
    const Certainty& band = *first->exploration.certainty();
    int inside = 0, all = 0;
    for (const Vec3& point :
         points_of(now.recording.tissue, now.exploration.certainty()->score, 0.0)) {
      ++all;
      if (std::abs(tissue.interpolate(band.score, tissue.project(point))) <= band.band_score)
        ++inside;
    }
    figures.push_back({"R6", "part of exp7's boundary in exp4's band",
                       static_cast<double>(inside) / all, 1.0, 1.0});
    figures.push_back(
        {"R6", "mean half width of exp4's band, mm", band.half_width_m * 1e3, 0.0, 1.5});
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
    if (episode.exploration.level()) {
      const Contour contour = episode.exploration.contour();
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

}  // namespace

void recordings(const ExperimentArguments& arguments) {
  const Scene scene = base_scene(arguments, replay_scene());
  const std::vector<Cell> cells = {{"all recordings", scene}};
  if (printed_scenes(cells, arguments)) return;
  if (arguments.recordings.empty())
    throw IoError(
        "experiment recordings: needs --recordings FOLDER, which holds fig_circle_forward.csv, "
        "exp4.csv and the others");
  std::vector<Figure> figures;
  std::size_t told = 0;
  const auto tell_new = [&] {
    for (; told < figures.size(); ++told) {
      const Figure& figure = figures[told];
      std::printf("%-3s %-66s %9.3f  [%g, %g]%s\n", figure.name.c_str(), figure.what.c_str(),
                  figure.value, figure.least, figure.most, figure.good() ? "" : "  MISSED");
    }
    std::fflush(stdout);
  };
  own_map(arguments, scene.with("field.trend", "constant"),
          figures);  // the map is of the whole field
  tell_new();
  truth_and_lag(arguments, scene, figures);
  tell_new();
  screening(arguments, figures);
  tell_new();
  fading(arguments, scene.with("field.screening", true), figures);
  tell_new();
  pokes(arguments, scene, figures);
  tell_new();
  std::string csv = "name,what,value,least,most,good\n";
  for (const Figure& figure : figures) {
    const std::array<std::string, 6> row = {figure.name,           figure.what,
                                            text_of(figure.value), text_of(figure.least),
                                            text_of(figure.most),  figure.good() ? "1" : "0"};
    csv += csv_line(row);
  }
  write_table(arguments, "recordings", csv);
}

}  // namespace palpation::tool
