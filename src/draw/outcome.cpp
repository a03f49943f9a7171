#include "draw/outcome.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>

#include "draw/place.h"
#include "draw/searched.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "results/run.h"

namespace palpation::draw {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
  throw IoError(path.string() + ": " + reason);
}

vtkSmartPointer<vtkPolyData> read_polydata(const fs::path& path) {
  if (!fs::is_regular_file(path)) fail(path, "no such file");
  vtkNew<vtkXMLPolyDataReader> reader;
  if (reader->CanReadFile(path.c_str()) == 0) fail(path, "not a VTK polygon file");
  reader->SetFileName(path.c_str());
  reader->Update();
  if (reader->GetErrorCode() != 0) fail(path, "not readable as a VTK polygon file");
  return reader->GetOutput();
}

vtkSmartPointer<vtkPolyData> read_surface(const fs::path& path) {
  vtkSmartPointer<vtkPolyData> surface = read_polydata(path);
  if (surface->GetNumberOfPolys() == 0) fail(path, "no triangles");
  vtkCellArray* triangles = surface->GetPolys();
  vtkIdType size = 0;
  const vtkIdType* corners = nullptr;
  for (vtkIdType cell = 0; cell < triangles->GetNumberOfCells(); ++cell) {
    triangles->GetCellAtId(cell, size, corners);
    const bool sound = size == 3 && std::all_of(corners, corners + size, [&](vtkIdType corner) {
                         return corner >= 0 && corner < surface->GetNumberOfPoints();
                       });
    if (!sound) fail(path, "cell " + std::to_string(cell) + " is no triangle of the file's points");
  }
  return surface;
}

std::vector<Vec3> points_of(vtkPolyData& lines, vtkIdType size, const vtkIdType* corners,
                            const fs::path& path) {
  std::vector<Vec3> points;
  for (vtkIdType i = 0; i < size; ++i) {
    if (corners[i] < 0 || corners[i] >= lines.GetNumberOfPoints())
      fail(path, "a line names a point that does not exist");
    points.emplace_back(Vec3::Zero());
    lines.GetPoint(corners[i], points.back().data());
  }
  return points;
}

std::vector<Curve> read_curves(const fs::path& path) {
  if (!fs::exists(path)) return {};
  const vtkSmartPointer<vtkPolyData> lines = read_polydata(path);
  auto* kinds = vtkStringArray::SafeDownCast(lines->GetCellData()->GetAbstractArray("kind_name"));
  if (lines->GetNumberOfLines() > 0 && kinds == nullptr)
    fail(path, "no cell array of strings named kind_name");
  std::vector<Curve> curves;
  vtkIdType size = 0;
  const vtkIdType* corners = nullptr;
  for (vtkIdType cell = 0; cell < lines->GetNumberOfLines(); ++cell) {
    lines->GetLines()->GetCellAtId(cell, size, corners);
    curves.push_back({kinds->GetValue(cell), points_of(*lines, size, corners, path)});
  }
  return curves;
}

/// A plan's or a boundary's own, where the measurements in the folder are what it was given.
fs::path readings_in(const fs::path& folder) {
  const fs::path used = folder / "readings_used.csv";
  return fs::exists(used) ? used : folder / "measurements.csv";
}

std::vector<Touch> read_touches(const fs::path& path) {
  if (!fs::exists(path)) return {};
  const Table table(path);
  const std::vector<double> x = table.numbers("x");
  const std::vector<double> y = table.numbers("y");
  const std::vector<double> z = table.numbers("z");
  const std::vector<double> batch = table.numbers("batch");
  const std::vector<std::string> kind = table.texts("kind");
  const std::vector<std::string> reason = table.texts("set_aside");
  std::vector<Touch> touches;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3 position(x[i], y[i], z[i]);
    if (!position.allFinite() || kind[i] == "missed") continue;
    touches.push_back({.position = position,
                       .initial = batch[i] == 0.0,
                       .on_the_way = kind[i] == "way",
                       .set_aside = !reason[i].empty()});
  }
  return touches;
}

std::optional<double> number_in(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

std::optional<ErrorNumbers> error_in(const Json& summary) {
  const auto found = summary.find("error");
  if (found == summary.end() || !found->is_object()) return std::nullopt;
  return ErrorNumbers{.symmetric_difference_mm2 = number_in(*found, "symmetric_difference_mm2"),
                      .missed_mm2 = number_in(*found, "missed_mm2"),
                      .extra_mm2 = number_in(*found, "extra_mm2"),
                      .percent_of_search_area = number_in(*found, "percent_of_search_area"),
                      .dice = number_in(*found, "dice")};
}

std::optional<BandNumbers> band_in(const Json& summary) {
  const auto found = summary.find("band");
  if (found == summary.end() || !found->is_object()) return std::nullopt;
  return BandNumbers{.probability = number_in(*found, "probability"),
                     .score = number_in(*found, "score"),
                     .half_width_mm = number_in(*found, "half_width_mm"),
                     .inner_area_mm2 = number_in(*found, "inner_area_mm2"),
                     .outer_area_mm2 = number_in(*found, "outer_area_mm2")};
}

/// Simulated tissue has a truth; of recorded tissue there is a map.
std::string truth_line_in(const Json& summary) {
  const auto found = summary.find("truth_is");
  return found != summary.end() && found->is_string() && *found != "the truth"
             ? found->get<std::string>()
             : "true boundary";
}

std::optional<double> cut_risk_in(const Json& summary) {
  const auto found = summary.find("cut");
  return found != summary.end() && found->is_object() ? number_in(*found, "risk") : std::nullopt;
}

/// What lies under nested keys, or null.
const Json& within(const Json& object, std::initializer_list<const char*> keys) {
  static const Json nothing;
  const Json* here = &object;
  for (const char* key : keys) {
    const auto found = here->find(key);
    if (!here->is_object() || found == here->end()) return nothing;
    here = &*found;
  }
  return *here;
}

std::optional<double> number_within(const Json& object, std::initializer_list<const char*> keys) {
  const Json& value = within(object, keys);
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

std::optional<RuledOut> ruled_out_in(const Json& summary) {
  const std::optional<double> diameter_mm = number_in(summary, "nothing_wider_than_mm");
  if (!diameter_mm) return std::nullopt;
  return RuledOut{*diameter_mm, number_within(summary, {"options", "band", "probability"})};
}

/// A run that has not stopped is one that is to go on: the tool's plan.
std::optional<Eigen::Matrix4d> from_tissue_in(const Json& summary) {
  const auto stopped = summary.find("stop_reason");
  if (stopped == summary.end() || !stopped->is_null()) return std::nullopt;
  const Json& rows = within(summary, {"options", "robot", "from_tissue"});
  const bool sound =
      rows.is_array() && rows.size() == 16 &&
      std::all_of(rows.begin(), rows.end(), [](const Json& x) { return x.is_number(); });
  if (!sound) return std::nullopt;
  Eigen::Matrix4d from_tissue;
  for (Eigen::Index i = 0; i < 16; ++i)
    from_tissue(i / 4, i % 4) = rows[static_cast<std::size_t>(i)].get<double>();
  return from_tissue;
}

std::string reading_unit_in(const Json& summary) {
  const Json& unit = within(summary, {"options", "reading_unit"});
  return unit.is_string() ? unit.get<std::string>() : std::string();
}

Summary read_summary(const fs::path& path) {
  if (!fs::exists(path)) {
    Summary summary;
    summary.reading_unit = reading_unit_in(results::begun_in(path.parent_path()));
    return summary;
  }
  const Json json = Json::parse(read_file(path), nullptr, /*allow_exceptions=*/false);
  if (!json.is_object()) fail(path, "not a JSON object");
  return {.band = band_in(json),
          .cut_risk = cut_risk_in(json),
          .truth_line = truth_line_in(json),
          .ruled_out = ruled_out_in(json),
          .level = number_in(json, "level"),
          .area_mm2 = number_in(json, "area_mm2"),
          .expected_error_mm2 = number_in(json, "expected_error_mm2"),
          .measurements = number_in(json, "measurements"),
          .noise_sd = number_within(json, {"learned", "noise_sd"}),
          .error = error_in(json),
          .reading_unit = reading_unit_in(json),
          .from_tissue = from_tissue_in(json)};
}

/// Waypoints are in the robot's frame.
void add_planned(const fs::path& path, const Eigen::Matrix4d& from_tissue,
                 std::vector<Touch>& touches) {
  if (!fs::exists(path)) return;
  const Table table(path);
  const std::vector<double> x = table.numbers("x");
  const std::vector<double> y = table.numbers("y");
  const std::vector<double> z = table.numbers("z");
  const Eigen::Matrix4d to_tissue = from_tissue.inverse();
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3 position = (to_tissue * Eigen::Vector4d(x[i], y[i], z[i], 1.0)).head<3>();
    if (position.allFinite())
      touches.push_back({.position = position, .planned = true, .index = static_cast<int>(i)});
  }
}

std::optional<Table> read_trace(const fs::path& path) {
  if (!fs::exists(path)) return std::nullopt;
  return Table(path);
}

std::vector<Vec3> places_along(const std::vector<Curve>& curves, const std::string& kind,
                               std::size_t wanted) {
  std::vector<Vec3> all;
  for (const Curve& curve : curves) {
    if (curve.kind == kind) all.insert(all.end(), curve.points.begin(), curve.points.end());
  }
  std::vector<Vec3> some;
  const std::size_t step = 1 + all.size() / wanted;
  for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

}  // namespace

vtkDataArray* Outcome::field(const std::string& name) const {
  vtkDataArray* array = surface->GetPointData()->GetArray(name.c_str());
  const bool usable = array != nullptr && array->GetNumberOfComponents() == 1 &&
                      array->GetNumberOfTuples() == surface->GetNumberOfPoints();
  return usable ? array : nullptr;
}

bool Outcome::has_curve(const std::string& kind) const {
  return std::any_of(curves.begin(), curves.end(),
                     [&](const Curve& curve) { return curve.kind == kind; });
}

bool Outcome::shows_band() const {
  return summary.band && summary.band->score && field("score") != nullptr;
}

std::optional<double> Outcome::level_along(const std::string& kind, const std::string& name) const {
  constexpr std::size_t kSamples = 40;
  vtkDataArray* values = field(name);
  if (values == nullptr) return std::nullopt;
  const TriangleTree tree(*surface);
  std::vector<double> found;
  for (const Vec3& place : places_along(curves, kind, kSamples)) {
    const double value = tree.value_at(*values, place);
    if (std::isfinite(value)) found.push_back(value);
  }
  if (found.empty()) return std::nullopt;
  const auto low = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 20);
  std::nth_element(found.begin(), low, found.end());
  return *low;
}

Outcome read_outcome(const fs::path& folder) {
  const fs::path surface = results::tissue_in(folder).value_or(folder / "surface.vtp");
  Outcome outcome{.surface = read_surface(surface),
                  .curves = read_curves(folder / "boundary.vtp"),
                  .touches = read_touches(readings_in(folder)),
                  .trace = read_trace(folder / "trace.csv"),
                  .summary = read_summary(folder / "summary.json")};
  if (outcome.summary.from_tissue)
    add_planned(folder / "waypoints.csv", *outcome.summary.from_tissue, outcome.touches);
  if (fs::exists(readings_in(folder))) add_beyond_search(outcome);
  return outcome;
}

}  // namespace palpation::draw
