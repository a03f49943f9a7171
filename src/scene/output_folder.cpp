#include "scene/output_folder.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "palpation/io/measurements.h"
#include "palpation/io/wkt.h"
#include "palpation/io/write_vtp.h"
#include "scene/boundary_curves.h"
#include "scene/parts.h"
#include "scene/remarks.h"
#include "scene/setup.h"
#include "scene/words.h"

extern char** environ;

namespace palpation::tool {
namespace {

using nlohmann::json;

constexpr double kMm2 = 1e6;  // in a square metre
constexpr double kMm = 1e3;   // in a metre

/// Names of files may be any bytes; what is no text in them must not keep the summary from being
/// written.
std::string document(const json& object) {
  return object.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

void remove_file(const std::filesystem::path& path) {
  std::error_code failure;
  std::filesystem::remove(path, failure);
  if (failure)
    throw WriteError(path.string() +
                     ": cannot remove what an earlier run left: " + failure.message());
}

json maybe(const std::optional<double>& value, double factor = 1.0) {
  if (value.has_value()) return *value * factor;
  return nullptr;
}

json error_json(const RegionError& error, double search_area_m2) {
  return {{"symmetric_difference_mm2", error.symmetric_difference_m2 * kMm2},
          {"missed_mm2", error.missed_m2 * kMm2},
          {"extra_mm2", error.extra_m2 * kMm2},
          {"percent_of_search_area", 100.0 * error.symmetric_difference_m2 / search_area_m2},
          {"dice", error.dice},
          {"hausdorff_mm", maybe(error.hausdorff_m, kMm)},
          {"mean_distance_mm", maybe(error.mean_distance_m, kMm)}};
}

json pair_mm(const Vec2& place_m) { return {place_m.x() * kMm, place_m.y() * kMm}; }

/// One part or hole, in chart millimetres.
json place_json(const TumourPart& part) {
  return {{"area_mm2", std::abs(part.area_m2) * kMm2},
          {"centroid_mm", pair_mm(part.centroid_m)},
          {"extent_mm", pair_mm(part.most_m - part.least_m)}};
}

json part_json(const TumourPart& part, const Surface& surface) {
  json result = place_json(part);
  result["position_mm"] = {part.position_m.x() * kMm, part.position_m.y() * kMm,
                           part.position_m.z() * kMm};
  result["probability"] = part.probability;
  result["touches_border"] = part.touches_border;
  result["holes"] = json::array();
  for (const Ring& hole : part.polygon.holes)
    result["holes"].push_back(place_json(measured(hole, surface)));
  return result;
}

/// What the band and the cut line enclose, and what is expected to be wrong; null where nothing is
/// known of a boundary.
void add_certainty(json& summary, const Episode& episode, double cut_risk) {
  for (const char* key : {"expected_missed_mm2", "expected_extra_mm2", "band", "cut"})
    summary[key] = nullptr;
  const std::optional<Certainty>& certainty = episode.exploration.certainty();
  if (!certainty || episode.exploration.tip_hides_all()) return;
  const Surface& surface = episode.exploration.surface();
  const double q = certainty->band_score, cut = Certainty::cut_score(cut_risk);
  summary["expected_missed_mm2"] = certainty->expected.missed_m2 * kMm2;
  summary["expected_extra_mm2"] = certainty->expected.extra_m2 * kMm2;
  summary["band"] = {{"probability", certainty->probability},
                     {"score", q},
                     {"half_width_mm", certainty->half_width_m * kMm},
                     {"inner_area_mm2", superlevel_area(surface, certainty->score, q) * kMm2},
                     {"outer_area_mm2", superlevel_area(surface, certainty->score, -q) * kMm2}};
  summary["cut"] = {{"risk", cut_risk},
                    {"score", cut},
                    {"area_mm2", superlevel_area(surface, certainty->score, cut) * kMm2}};
}

std::string cell(const std::optional<double>& value, double factor = 1.0) {
  return value ? text_of(*value * factor) : "";
}

std::string trace_csv(const Trace& trace, double search_area_m2) {
  std::string text = "batch,measurements,path_mm,level,expected_error_mm2,error_percent\n";
  for (const TraceRow& row : trace) {
    text +=
        std::to_string(row.batch) + "," + std::to_string(row.measurements) + "," +
        text_of(row.path_m * kMm) + "," + cell(row.level) + "," +
        cell(row.expected_error_m2, kMm2) + "," +
        (row.error ? text_of(100.0 * row.error->symmetric_difference_m2 / search_area_m2) : "") +
        "\n";
  }
  return text;
}

/// `legs`: for places on the way, which stop each leads to.
std::string waypoint_csv(const std::vector<Waypoint>& waypoints,
                         const std::vector<int>* legs = nullptr) {
  std::string text =
      "index,x,y,z,approach_x,approach_y,approach_z,indented_x,indented_y,indented_z,normal_x,"
      "normal_y,normal_z,qx,qy,qz,qw,expected_force_"
      "n";
  text += legs != nullptr ? ",leg\n" : "\n";
  Eigen::Vector4d last = Eigen::Vector4d::Zero();
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const Waypoint& waypoint = waypoints[i];
    // Of the two quaternions of a pose the one nearer to the last: who filters them must not see
    // them jump.
    Eigen::Vector4d turn = quaternion(waypoint.rotation);
    if (turn.dot(last) < 0.0) turn = -turn;
    last = turn;
    text += std::to_string(i);
    for (const Vec3& triple :
         {waypoint.position, waypoint.approach, waypoint.indented, waypoint.normal}) {
      for (double coordinate : triple) text += "," + text_of(coordinate);
    }
    for (double coefficient : turn) text += "," + text_of(coefficient);
    text += "," + text_of(waypoint.expected_force_n);
    if (legs != nullptr) text += "," + std::to_string((*legs)[i]);
    text += "\n";
  }
  return text;
}

using NamedFields = std::vector<std::pair<std::string, Field>>;

NamedFields fields_of(const Episode& episode, const World* world) {
  const Snapshot now = snapshot(episode);
  NamedFields fields{{"mean", now.mean}, {"stddev", now.stddev}, {"acquisition", now.acquisition}};
  if (now.mean_detrended.size() > 0) fields.emplace_back("mean_detrended", now.mean_detrended);
  if (now.score.size() > 0) {
    fields.emplace_back("score", now.score);
    fields.emplace_back("probability_inside", now.probability_inside);
  }
  if (world != nullptr) fields.emplace_back("truth", world->truth);
  // Curved tissue may hide a part of itself: a picture can show it laid flat.
  if (const Surface& surface = episode.exploration.surface(); !surface.is_planar()) {
    fields.emplace_back("chart_u", surface.chart().uv.col(0));
    fields.emplace_back("chart_v", surface.chart().uv.col(1));
  }
  return fields;
}

}  // namespace

void make_folder(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure || !std::filesystem::is_directory(folder))
    throw WriteError(folder.string() + ": cannot make this folder: " +
                     (failure ? failure.message() : "there is a file of that name"));
}

OutputFolder::OutputFolder(std::filesystem::path folder, const Scene& scene, const Surface& surface)
    : folder_(std::move(folder)), scene_(scene), surface_(surface) {
  make_folder(folder_);
}

/// The summary is the last file of a run: without it a folder is not finished.
void OutputFolder::begin() {
  if (begun_) return;
  remove_file(folder_ / "summary.json");
  remove_what_an_earlier_run_left();
  begun_ = true;
}

void OutputFolder::write_step(const Episode& episode, const World* world) {
  begin();
  if (steps_.empty()) make_folder(folder_ / "steps");
  std::string number = std::to_string(episode.exploration.batch() - 1);
  number.insert(0, number.size() < 3 ? 3 - number.size() : 0, '0');
  const std::string name = "steps/step_" + number + ".vtp";
  write_surface_vtp(folder_ / name, surface_, fields_of(episode, world));
  steps_.push_back(name);
}

namespace {

/// What is in force of field.reduced_rank: null where the belief is exact.
json reduced_rank_json(const Belief& belief) {
  const std::optional<ReducedRank> reduced = belief.reduced_rank();
  if (!reduced) return nullptr;
  return {{"rank", reduced->rank},
          {"mean_off_at_most", reduced->mean_error},
          {"variance_off_at_most", reduced->variance_error}};
}

}  // namespace

json OutputFolder::summary(const Episode& episode) const {
  const Exploration& exploration = episode.exploration;
  json parts = json::array();
  for (const TumourPart& part : parts_of(episode)) parts.push_back(part_json(part, surface_));
  const std::optional<Level>& level = exploration.level();
  std::vector<std::string> warnings = warnings_;
  const std::vector<std::string> remarks = boundary_remarks(episode);
  warnings.insert(warnings.end(), remarks.begin(), remarks.end());
  json result = {
      {"version", 1},
      {"scene", scene_.name()},
      {"seed", scene_.seed()},
      {"options", scene_.complete()},
      {"computed", surface_.computed()},
      {"vertices", surface_.vertex_count()},
      {"measurements", exploration.palpations().size()},
      {"search_area_mm2", surface_.area() * kMm2},
      {"level", level ? json(level->value) : json(nullptr)},
      {"level_sd", level ? maybe(level->stddev) : json(nullptr)},
      {"area_mm2", surface_area(surface_, episode.estimate) * kMm2},
      {"parts", parts},
      {"expected_error_mm2",
       episode.trace.empty() ? json(nullptr) : maybe(episode.trace.back().expected_error_m2, kMm2)},
      {"path_mm", episode.path_m * kMm},
      {"learned",
       {{"length_mm", exploration.belief().prior().kernel().length_m * kMm},
        {"signal_sd", exploration.belief().signal_sd()},
        {"noise_sd", std::sqrt(exploration.belief().noise_variance())}}},
      {"precision", exploration.belief().options().single_precision ? "single" : "double"},
      {"reduced_rank", reduced_rank_json(exploration.belief())},
      {"warnings", warnings},
      {"stop_reason", episode.stop_reason().empty() ? json(nullptr) : json(episode.stop_reason())},
      {"chart_hash", surface_.chart().hash()}};
  if (field_of(scene_).probe.has_lag()) {
    result["lag_mm"] = exploration.lag() ? json(exploration.lag()->value_m * kMm) : json(nullptr);
    result["lag_sd_mm"] =
        exploration.lag() ? json(exploration.lag()->stddev_m * kMm) : json(nullptr);
  }
  const bool found = !episode.estimate.empty();
  const json ruled_out = maybe(diameter_ruled_out_m(episode), kMm);
  result["nothing_wider_than_mm"] = found ? json(nullptr) : ruled_out;
  result["no_other_wider_than_mm"] = found ? ruled_out : json(nullptr);
  add_certainty(result, episode, scene_.number("band.cut_risk"));
  if (episode.truth) {
    result["truth_is"] = episode.truth_is;
    result["error"] = episode.error ? error_json(*episode.error, surface_.area()) : json(nullptr);
  }
  return result;
}

void OutputFolder::write_boundary(const Episode& episode, const World* world) {
  write_atomically(folder_ / "boundary.wkt", to_wkt(episode.estimate) + "\n");
  std::vector<BoundaryCurve> curves;
  const auto add = [&](const Field& field, double level, CurveKind kind) {
    const std::vector<BoundaryCurve> more = boundary_curves(surface_, field, level, kind);
    curves.insert(curves.end(), more.begin(), more.end());
  };
  if (episode.exploration.level() && episode.exploration.belief().site_count() > 0) {
    const Contour contour = episode.exploration.contour();
    add(contour.field, contour.level, CurveKind::Estimate);
  }
  if (const std::optional<Certainty>& certainty = episode.exploration.certainty()) {
    add(certainty->score, certainty->band_score, CurveKind::BandInner);
    add(certainty->score, -certainty->band_score, CurveKind::BandOuter);
    add(certainty->score, Certainty::cut_score(scene_.number("band.cut_risk")), CurveKind::Cut);
  }
  if (world != nullptr) add(world->truth, world->true_level, CurveKind::Truth);
  write_boundary_vtp(folder_ / "boundary.vtp", surface_, curves);
}

/// A folder that holds two runs contradicts itself: a robot must not follow the waypoints of
/// another plan. What was measured stays until it is replaced: it may be all there is.
void OutputFolder::remove_what_an_earlier_run_left() const {
  for (const char* name :
       {"waypoints.csv", "path.csv", "trace.csv", "timings.json", "boundary.wkt", "boundary.vtp",
        "surface.vtp", "steps.pvd", "picture.png", "convergence.png"}) {
    remove_file(folder_ / name);
  }
  if (!std::filesystem::is_directory(folder_ / "steps")) return;
  std::vector<std::filesystem::path> stale;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "steps")) {
    if (entry.path().filename().string().starts_with("step_")) stale.push_back(entry.path());
  }
  for (const auto& path : stale) remove_file(path);
}

void OutputFolder::write(const Episode& episode, const World* world, const json& timings) {
  begin();
  write_surface_vtp(folder_ / "surface.vtp", surface_, fields_of(episode, world));
  write_boundary(episode, world);
  write_atomically(folder_ / "measurements.csv",
                   measurements_csv(surface_, episode.exploration.palpations()));
  if (!episode.trace.empty())
    write_atomically(folder_ / "trace.csv", trace_csv(episode.trace, surface_.area()));
  if (!steps_.empty()) write_pvd(folder_ / "steps.pvd", steps_);
  write_atomically(folder_ / "timings.json", document(timings));
  write_atomically(folder_ / "summary.json", document(summary(episode)));
}

void OutputFolder::write_waypoints(const std::vector<Waypoint>& stops,
                                   const std::vector<Waypoint>& way, const std::vector<int>& legs) {
  begin();
  write_atomically(folder_ / "waypoints.csv", waypoint_csv(stops));
  write_atomically(folder_ / "path.csv", waypoint_csv(way, &legs));
}

void OutputFolder::write_comparison(const RegionError& error) {
  for (const char* name : {"measurements.csv", "waypoints.csv", "boundary.wkt"}) {
    if (!std::filesystem::exists(folder_ / name)) continue;
    throw IoError(folder_.string() + ": holds a run (" + name +
                  "), whose summary.json a comparison would replace: give it another folder");
  }
  const json result = {{"version", 1},
                       {"scene", scene_.name()},
                       {"search_area_mm2", surface_.area() * kMm2},
                       {"error", error_json(error, surface_.area())},
                       {"warnings", warnings_},
                       {"chart_hash", surface_.chart().hash()}};
  write_atomically(folder_ / "summary.json", document(result));
}

std::optional<std::string> OutputFolder::draw() const { return run_draw({folder_.string()}); }

std::optional<std::string> run_draw(const std::vector<std::string>& arguments) {
  std::error_code failure;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", failure);
  const std::string program = (self.parent_path() / "palpate-draw").string();
  if (failure || ::access(program.c_str(), X_OK) != 0)
    return "the program palpate-draw does not lie beside palpate";

  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& one : words) pointers.push_back(one.data());
  pointers.push_back(nullptr);

  std::array<int, 2> channel{};
  if (::pipe2(channel.data(), O_CLOEXEC) != 0) return "no pipe to palpate-draw";
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, channel[1], STDERR_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int spawned =
      ::posix_spawn(&child, program.c_str(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(channel[1]);
  std::string said;
  std::array<char, 512> bytes{};
  for (ssize_t count = 0;
       spawned == 0 && (count = ::read(channel[0], bytes.data(), bytes.size())) > 0;) {
    if (said.size() < 4096) said.append(bytes.data(), static_cast<std::size_t>(count));
  }
  ::close(channel[0]);
  if (spawned != 0) return "palpate-draw cannot be started";
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return std::nullopt;
  while (!said.empty() && said.back() == '\n') said.pop_back();
  if (WIFSIGNALED(status))
    return "the graphics stack failed (signal " + std::to_string(WTERMSIG(status)) + ")";
  return said.empty() ? "palpate-draw failed" : said;
}

}  // namespace palpation::tool
