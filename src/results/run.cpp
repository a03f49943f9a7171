#include "results/run.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "palpation/io/csv.h"

namespace palpation::results {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::uintmax_t kMostSummary_bytes = std::uintmax_t{1} << 28;

json read_summary(const fs::path& path) {
  if (!fs::exists(path)) return nullptr;
  json summary = json::parse(read_file(path, kMostSummary_bytes), nullptr,
                             /*allow_exceptions=*/false);
  if (!summary.is_object()) throw IoError(path.string() + ": is no JSON object");
  return summary;
}

std::string text_at(const CsvTable& table, std::size_t row, std::string_view column) {
  const std::optional<std::size_t> found = find_column(table, column);
  return found ? std::string(table.cell(row, *found)) : std::string();
}

/// From the tissue to the robot, row by row; identity where the summary says none.
Eigen::Matrix4d from_tissue(const Run& run) {
  const json& told = run.told({"options", "robot", "from_tissue"});
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  if (!told.is_array() || told.size() != 16) return matrix;
  for (int i = 0; i < 16; ++i) {
    const json& number = told[static_cast<std::size_t>(i)];
    if (!number.is_number()) return Eigen::Matrix4d::Identity();
    matrix(i / 4, i % 4) = number.get<double>();
  }
  return matrix;
}

/// Waypoints are in the robot's frame. Those of a run that simulated or replayed are felt already;
/// only a plan leaves its batch to be felt, and only a plan takes readings and gives waypoints.
std::vector<Vec3> read_next_stops(const Run& run) {
  const fs::path path = run.folder / "waypoints.csv";
  if (!fs::exists(path) || !fs::exists(run.folder / "readings_used.csv")) return {};
  const CsvTable table = read_csv(path);
  std::vector<Vec3> stops;
  for (std::size_t row = 0; row < table.row_count(); ++row)
    stops.push_back(run.in_mesh(place_at(table, row)));
  return stops;
}

/// "step_007.vtp", in the order of their numbers.
std::vector<fs::path> steps_in(const fs::path& folder) {
  std::vector<fs::path> steps;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder / "steps", none)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("step_") && entry.path().extension() == ".vtp")
      steps.push_back(entry.path());
  }
  std::ranges::sort(steps, [](const fs::path& a, const fs::path& b) {
    const std::string left = a.filename().string(), right = b.filename().string();
    return left.size() != right.size() ? left.size() < right.size() : left < right;
  });
  return steps;
}

}  // namespace

Vec3 place_at(const CsvTable& table, std::size_t row) {
  return {finite_number_at(table, row, column_index(table, "x")),
          finite_number_at(table, row, column_index(table, "y")),
          finite_number_at(table, row, column_index(table, "z"))};
}

const json& Run::told(std::initializer_list<const char*> keys) const {
  static const json nothing;
  const json* here = summary.is_null() ? &begun : &summary;
  for (const char* key : keys) {
    if (!here->is_object()) return nothing;
    const auto found = here->find(key);
    if (found == here->end()) return nothing;
    here = &*found;
  }
  return *here;
}

std::optional<double> Run::number(std::initializer_list<const char*> keys) const {
  const json& value = told(keys);
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

std::string Run::reading_unit() const {
  const json& unit = told({"options", "reading_unit"});
  return unit.is_string() ? unit.get<std::string>() : std::string();
}

Frame Run::frame() const {
  if (tissue.frame) return *tissue.frame;
  const json& frame = told({"options", "surface", "frame"});
  if (!frame.is_string()) return Frame::Mesh;
  const std::string name = frame.get<std::string>();
  return name == "RAS" ? Frame::Ras : name == "LPS" ? Frame::Lps : Frame::Mesh;
}

Vec3 Run::in_mesh(const Vec3& p_R) const {
  return (from_tissue(*this).inverse() * p_R.homogeneous()).head<3>();
}

std::optional<fs::path> tissue_in(const fs::path& folder) {
  const fs::path surface = folder / "surface.vtp";
  if (fs::exists(surface)) return surface;
  const std::vector<fs::path> steps = steps_in(folder);
  return steps.empty() ? std::nullopt : std::optional(steps.back());
}

json begun_in(const fs::path& folder) {
  const fs::path path = folder / "run.json";
  if (!fs::is_regular_file(path)) return nullptr;
  const json record = json::parse(read_file(path, kMostSummary_bytes), nullptr,
                                  /*allow_exceptions=*/false);
  if (!record.is_object() || record.value("program", json()) != "palpate") return nullptr;
  json begun = record.value("begun", json());
  return begun.is_object() ? begun : json();
}

fs::path touches_in(const fs::path& folder) {
  const fs::path used = folder / "readings_used.csv";
  return fs::exists(used) ? used : folder / "measurements.csv";
}

std::vector<Touch> read_touches(const fs::path& path) {
  if (!fs::exists(path)) return {};
  const CsvTable table = read_csv(path);
  std::vector<Touch> touches;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    Touch touch{.number = static_cast<int>(row) + 1,
                .place = place_at(table, row),
                .reading = number_at(table, row, column_index(table, "reading")),
                .kind = text_at(table, row, "kind"),
                .set_aside = text_at(table, row, "set_aside")};
    if (touch.kind.empty()) touch.kind = "stop";
    if (touch.reading && !std::isfinite(*touch.reading)) touch.reading.reset();
    if (const auto column = find_column(table, "batch"))
      touch.batch =
          static_cast<int>(std::clamp(number_at(table, row, *column).value_or(0.0), 0.0, 1e6));
    touches.push_back(std::move(touch));
  }
  return touches;
}

Run read_run(const fs::path& folder) {
  Run run;
  run.folder = folder;
  run.steps = steps_in(folder);
  const std::optional<fs::path> tissue = tissue_in(folder);
  if (!tissue)
    throw IoError(folder.string() +
                  ": holds no run of palpate, neither surface.vtp nor steps: give the folder that "
                  "--out named");
  run.summary = read_summary(folder / "summary.json");
  if (run.summary.is_null()) run.begun = begun_in(folder);
  run.tissue = read_tissue(*tissue);
  if (fs::exists(folder / "boundary.vtp")) run.curves = read_curves(folder / "boundary.vtp");
  run.knows_touches = fs::exists(touches_in(folder));
  run.touches = read_touches(touches_in(folder));
  run.next_stops = read_next_stops(run);
  return run;
}

}  // namespace palpation::results
