#include "results/tables.h"

#include <algorithm>
#include <cmath>

#include "io/length_scale.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "palpation/io/csv.h"
#include "results/parts.h"

namespace palpation::results {
namespace {

using nlohmann::json;
using Cells = std::vector<std::string>;

const Cells kPlace = {"x [mm]", "y [mm]", "z [mm]"};

std::string text_mm(double metres) { return text_of(from_metres(metres, LengthUnit::Millimetre)); }

void add_place(Cells& cells, const Vec3& place) {
  for (const double coordinate : place) cells.push_back(text_mm(coordinate));
}

/// The name with the unit behind it, where there is one.
std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " [" + unit + "]";
}

/// The name of a column for a field of surface.vtp.
std::string column_of(const std::string& field, const std::string& unit) {
  const bool is_reading =
      field == "mean" || field == "stddev" || field == "mean_detrended" || field == "truth";
  return is_reading ? with_unit(field, unit) : field;
}

std::string tissue_csv(const Run& run) {
  Cells header = {"vertex"};
  header.insert(header.end(), kPlace.begin(), kPlace.end());
  std::vector<const Field*> fields;
  for (const std::string& name : shown_fields()) {
    if (name == "above_level" || run.tissue.field(name) == nullptr) continue;
    fields.push_back(run.tissue.field(name));
    header.push_back(column_of(name, run.reading_unit()));
  }
  header.emplace_back("searched");
  const std::vector<double> beyond = beyond_search(run);
  std::string text = csv_line(header);
  for (Eigen::Index i = 0; i < run.tissue.mesh.vertices.rows(); ++i) {
    Cells cells = {std::to_string(i)};
    add_place(cells, run.tissue.mesh.vertices.row(i));
    for (const Field* field : fields)
      cells.push_back(std::isfinite((*field)[i]) ? text_of((*field)[i]) : std::string());
    cells.emplace_back(beyond[static_cast<std::size_t>(i)] >= 0.0 ? "0" : "1");
    text += csv_line(cells);
  }
  return text;
}

/// All columns of the file: what a robot or a person added is kept.
std::string touches_csv(const Run& run) {
  const CsvTable table = read_csv(touches_in(run.folder));
  const std::string unit = run.reading_unit();
  Cells header = {"number"};
  for (const std::string& name : table.columns()) {
    const bool is_place = name == "x" || name == "y" || name == "z";
    header.push_back(is_place                                    ? name + " [mm]"
                     : name == "reading"                         ? with_unit(name, unit)
                     : name == "noise_variance" && !unit.empty() ? name + " [(" + unit + ")^2]"
                                                                 : name);
  }
  std::string text = csv_line(header);
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    Cells cells = {std::to_string(row + 1)};
    for (std::size_t column = 0; column < table.columns().size(); ++column) {
      const std::string& name = table.columns()[column];
      const bool is_place = name == "x" || name == "y" || name == "z";
      cells.push_back(is_place ? text_mm(finite_number_at(table, row, column))
                               : std::string(table.cell(row, column)));
    }
    text += csv_line(cells);
  }
  return text;
}

std::string boundary_csv(const Run& run) {
  Cells header = {"line", "kind", "part", "hole", "point"};
  header.insert(header.end(), kPlace.begin(), kPlace.end());
  std::string text = csv_line(header);
  for (std::size_t line = 0; line < run.curves.size(); ++line) {
    const Curve& curve = run.curves[line];
    for (std::size_t point = 0; point < curve.points.size(); ++point) {
      Cells cells = {std::to_string(line), curve.kind, std::to_string(curve.part),
                     curve.is_hole ? "1" : "0", std::to_string(point)};
      add_place(cells, curve.points[point]);
      text += csv_line(cells);
    }
  }
  return text;
}

std::string cell_of(const json& value) {
  if (value.is_number()) return text_of(value.get<double>());
  if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
  return value.is_string() ? value.get<std::string>() : std::string();
}

const json& at(const json& object, const char* key, std::size_t index) {
  static const json nothing;
  if (!object.is_object() || !object.contains(key)) return nothing;
  const json& list = object.at(key);
  return list.is_array() && index < list.size() ? list.at(index) : nothing;
}

std::string parts_csv(const json& parts) {
  std::string text = csv_line(Cells{"part", "area [mm2]", "probability", "touches_border", "x [mm]",
                                    "y [mm]", "z [mm]", "extent_u [mm]", "extent_v [mm]", "holes"});
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const json& part = parts[i];
    const auto value = [&](const char* key) {
      return part.is_object() && part.contains(key) ? cell_of(part.at(key)) : std::string();
    };
    const bool has_holes = part.is_object() && part.contains("holes") && part["holes"].is_array();
    text += csv_line(Cells{std::to_string(i), value("area_mm2"), value("probability"),
                           value("touches_border"), cell_of(at(part, "position_mm", 0)),
                           cell_of(at(part, "position_mm", 1)), cell_of(at(part, "position_mm", 2)),
                           cell_of(at(part, "extent_mm", 0)), cell_of(at(part, "extent_mm", 1)),
                           has_holes ? std::to_string(part["holes"].size()) : ""});
  }
  return text;
}

std::string next_stops_csv(const Run& run) {
  Cells header = {"stop"};
  header.insert(header.end(), kPlace.begin(), kPlace.end());
  std::string text = csv_line(header);
  for (std::size_t i = 0; i < run.next_stops.size(); ++i) {
    Cells cells = {std::to_string(i + 1)};
    add_place(cells, run.next_stops[i]);
    text += csv_line(cells);
  }
  return text;
}

/// trace.csv with its units in brackets.
std::string batches_csv(const Run& run) {
  const CsvTable table = read_csv(run.folder / "trace.csv");
  const std::map<std::string, std::string> names = {
      {"path_mm", "path [mm]"},
      {"level", with_unit("level", run.reading_unit())},
      {"expected_error_mm2", "expected_error [mm2]"},
      {"error_percent", "error [% of the search area]"}};
  Cells header;
  for (const std::string& name : table.columns()) {
    const auto found = names.find(name);
    header.push_back(found == names.end() ? name : found->second);
  }
  std::string text = csv_line(header);
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    Cells cells;
    for (std::size_t column = 0; column < table.columns().size(); ++column)
      cells.emplace_back(table.cell(row, column));
    text += csv_line(cells);
  }
  return text;
}

}  // namespace

std::map<std::string, std::string> tables_of(const Run& run) {
  std::map<std::string, std::string> tables{{"tissue.csv", tissue_csv(run)}};
  if (!run.touches.empty()) tables["touches.csv"] = touches_csv(run);
  if (!run.curves.empty()) tables["boundary.csv"] = boundary_csv(run);
  if (const json& parts = run.told({"parts"}); parts.is_array() && !parts.empty())
    tables["parts.csv"] = parts_csv(parts);
  if (!run.next_stops.empty()) tables["next_stops.csv"] = next_stops_csv(run);
  if (std::filesystem::exists(run.folder / "trace.csv")) tables["batches.csv"] = batches_csv(run);
  return tables;
}

}  // namespace palpation::results
