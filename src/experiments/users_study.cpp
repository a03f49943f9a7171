// experiment study: lists of values and a folder of meshes, as a user asks for them.
#include <algorithm>
#include <cstdio>

#include "experiments/experiment.h"
#include "experiments/in_cell.h"
#include "experiments/lazy_tissue.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "palpation/io/csv.h"
#include "scene/digest.h"
#include "scene/words.h"
#include "scene/worlds.h"

namespace palpation::tool {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* kForm =
    R"({"scene": "planar.json", "vary": {"plan.batch": [5, 10]}, "meshes": "folder", "trials": 5})";

[[noreturn]] void refuse(const fs::path& path, const std::string& words) {
  throw IoError(path.string() + ": " + words + "; a study looks like " + kForm);
}

json read_json(const fs::path& path) {
  const json told = json::parse(read_file(path), nullptr, false);
  if (!told.is_object()) refuse(path, "is no JSON object");
  return told;
}

void check(const fs::path& path, const json& told) {
  for (const auto& [key, value] : told.items()) {
    if (key != "scene" && key != "vary" && key != "meshes" && key != "trials")
      refuse(path, key + ": is no key of a study");
  }
  if (!told.contains("scene") || !told["scene"].is_string())
    refuse(path, "scene: must name a scene's file");
  if (told.contains("meshes") && !told["meshes"].is_string())
    refuse(path, "meshes: must name a folder");
  if (told.contains("trials") &&
      (!told["trials"].is_number_integer() || told["trials"] < 1 || told["trials"] > 1'000'000))
    refuse(path, "trials: must be a whole number from 1 to 1000000");
  if (!told.contains("vary")) return;
  if (!told["vary"].is_object()) refuse(path, "vary: must be an object of lists");
  for (const auto& [key, values] : told["vary"].items()) {
    if (!values.is_array() || values.empty()) refuse(path, "vary: " + key + ": must be a list");
  }
}

/// The meshes of a folder by name, in the order of their names.
std::vector<fs::path> meshes_in(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> meshes;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string ending = entry.path().extension().string();
    if (ending == ".ply" || ending == ".obj" || ending == ".off" || ending == ".stl" ||
        ending == ".vtp")
      meshes.push_back(fs::absolute(entry.path()));
  }
  if (error) throw IoError(folder.string() + ": cannot read: " + error.message());
  if (meshes.empty())
    throw IoError(folder.string() + ": holds no mesh (.ply, .obj, .off, .stl or .vtp)");
  std::sort(meshes.begin(), meshes.end());
  return meshes;
}

std::string value_text(const json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// Every cell with every one of these values of a key.
std::vector<Cell> varied(const std::vector<Cell>& cells, const std::string& key,
                         const std::vector<std::pair<std::string, json>>& values) {
  std::vector<Cell> all;
  for (const Cell& cell : cells) {
    for (const auto& [text, value] : values) {
      Cell one = cell;
      one.name += (cell.name.empty() ? "" : ", ") + key + " " + text;
      one.scene = in_cell(one.name, [&] { return cell.scene.with(key, value); });
      one.labels.set(key, text);
      all.push_back(std::move(one));
    }
  }
  return all;
}

std::vector<Cell> cells_of(const fs::path& path, const json& told, const Scene& base) {
  std::vector<Cell> cells = {{.name = "", .scene = base}};
  if (told.contains("meshes")) {
    std::vector<std::pair<std::string, json>> meshes;
    for (const fs::path& mesh : meshes_in(path.parent_path() / told["meshes"].get<std::string>()))
      meshes.emplace_back(mesh.filename().string(), mesh.string());
    cells = varied(cells, "surface.mesh", meshes);
  }
  const json vary = told.value("vary", json::object());
  for (const auto& [key, list] : vary.items()) {
    std::vector<std::pair<std::string, json>> values;
    for (const json& value : list) values.emplace_back(value_text(value), value);
    cells = varied(cells, key, values);
  }
  if (cells.size() == 1 && cells.front().name.empty()) cells.front().name = "the scene";
  return cells;
}

/// Names are made of values: words with commas, lists, objects with quotes.
std::string csv_cell(const std::string& text) {
  std::string line = csv_line(std::vector{text});
  line.pop_back();
  return line;
}

/// All that a run tells against its phantom.
Figures figures_of(const Episode& episode) {
  const Exploration& exploration = episode.exploration;
  const double area_m2 = exploration.surface().area();
  const bool found = !episode.estimate.empty();
  Figures row;
  row.set("readings", static_cast<double>(exploration.readings().size()))
      .set("path_mm", episode.course.length_m * 1e3)
      .set("stop_reason", episode.stop_reason())
      .set("found", found)
      .set("error_mm2", (episode.error ? episode.error->symmetric_difference_m2 : area_m2) * 1e6);
  if (episode.error)
    row.set("missed_mm2", episode.error->missed_m2 * 1e6)
        .set("extra_mm2", episode.error->extra_m2 * 1e6)
        .set("dice", episode.error->dice);
  if (found && exploration.conclusion().certainty)
    row.set("expected_error_mm2",
            exploration.conclusion().certainty->expected.symmetric_difference_m2() * 1e6)
        .set("half_width_mm", exploration.conclusion().certainty->half_width_m * 1e3);
  return row;
}

}  // namespace

Study users_study(const ExperimentArguments& arguments) {
  const fs::path& path = arguments.scene;
  if (path.empty())
    throw InvalidInput(std::string("experiment study: needs a study, a JSON file such as ") +
                       kForm);
  const json told = read_json(path);
  check(path, told);
  const Scene base =
      Scene::read(path.parent_path() / told["scene"].get<std::string>(), arguments.overrides);
  Study study{.cells = cells_of(path, told, base), .trials = told.value("trials", 0)};
  std::erase_if(study.cells, [&](const Cell& cell) { return !is_chosen(cell.name, arguments); });
  study.columns = label_columns(study.cells);
  study.columns.insert(study.columns.end(),
                       {"readings", "path_mm", "stop_reason", "found", "error_mm2", "missed_mm2",
                        "extra_mm2", "dice", "expected_error_mm2", "half_width_mm"});
  std::vector<LazyTissue> tissues;
  for (const Cell& cell : study.cells) tissues.emplace_back(cell.scene);
  study.mesh_digest = [tissues](std::size_t cell) { return tissues[cell].mesh_digest(); };
  study.run = [tissues, cells = study.cells](std::size_t cell, std::uint64_t seed) {
    const Scene scene = cells[cell].scene.with("seed", seed);
    const Surface& surface = tissues[cell].surface();
    return std::vector{figures_of(run_episode(scene, surface, simulated_world(scene, surface)))};
  };
  return study;
}

void report_users_study(const Results& results, const ReportFolder& folder) {
  std::printf(
      "\nMean +- standard error of %d trials; found: in how many, with its 95 %% interval\n",
      results.trials());
  std::printf("%22s%22s%22s%10s  %s\n", "mm2 wrong", "mm2 expected", "Dice", "found", "cell");
  std::string csv = std::string("cell,trials,error_mm2,") + kStatisticsColumns +
                    ",expected_error_mm2,dice,found,found_low_95,found_high_95\n";
  for (std::size_t i = 0; i < results.manifest.cells.size(); ++i) {
    const std::vector<Figures> trials = results.of(i);
    const int count = static_cast<int>(trials.size());
    const Statistics error = statistics(trials, "error_mm2"),
                     expected = statistics(trials, "expected_error_mm2"),
                     dice = statistics(trials, "dice");
    const auto found = static_cast<int>(
        std::ranges::count_if(trials, [](const Figures& trial) { return trial.flag("found"); }));
    const Interval interval = wilson_interval(found, count);
    const std::string& name = results.manifest.cells[i].name;
    std::printf("%22s%22s%22s%4d of %-3d  %s\n", in_words(error).c_str(),
                in_words(expected).c_str(), in_words(dice).c_str(), found, count, name.c_str());
    csv += csv_cell(name) + "," + std::to_string(count) + "," + csv_of(error) + "," +
           text_of(expected.mean) + "," + text_of(dice.mean) + "," + std::to_string(found) + "," +
           text_of(interval.low) + "," + text_of(interval.high) + "\n";
  }
  folder.write("study", csv);
}

}  // namespace palpation::tool
