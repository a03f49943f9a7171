/// A run as its folder tells of it: what was found, felt and planned, from the files alone.
///
/// Places are metres in the mesh's frame. What a file does not say is absent, never a guess.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "palpation/geometry/triangle_mesh.h"
#include "palpation/io/coordinates.h"
#include "palpation/io/csv.h"

namespace palpation::results {

/// A row of measurements.csv or readings_used.csv.
struct Touch {
  int number = 0;  ///< from 1, in the order of the rows
  Vec3 place = Vec3::Zero();
  std::optional<double> reading;  ///< none of a stop that could not be touched
  int batch = 0;
  std::string kind;       ///< stop, way or missed
  std::string set_aside;  ///< why it is not used; empty: it is

  bool is_missed() const { return kind == "missed"; }
  bool counts() const { return !is_missed() && set_aside.empty(); }
};

/// A closed line of boundary.vtp; the first point is not repeated.
struct Curve {
  std::string kind;  ///< estimate, truth, band_inner, band_outer or cut
  int part = 0;
  bool is_hole = false;
  std::vector<Vec3> points;
};

/// The tissue with its fields at the vertices, by their names in the file.
struct Tissue {
  TriangleMesh mesh;
  std::map<std::string, Field> fields;
  std::optional<Frame> frame;  ///< as the file says

  /// Null where there is none of that name.
  const Field* field(const std::string& name) const;
};

struct Run {
  std::filesystem::path folder;
  Tissue tissue;  ///< as it was believed last: of a run that did not end, after its last batch
  std::vector<Curve> curves;
  std::vector<Touch> touches;
  bool knows_touches = false;    ///< whether there is a table of them, if only an empty one
  std::vector<Vec3> next_stops;  ///< of a plan
  nlohmann::json summary;        ///< null of a run that did not end
  nlohmann::json begun;          ///< of such a one: what was known of it when it began
  std::vector<std::filesystem::path> steps;

  /// What lies under nested keys of the summary, or of what was known before; or null.
  const nlohmann::json& told(std::initializer_list<const char*> keys) const;
  std::optional<double> number(std::initializer_list<const char*> keys) const;
  /// Empty where nobody says.
  std::string reading_unit() const;
  /// As the tissue's file says, else the scene.
  Frame frame() const;
  /// A place in the robot's frame, as waypoints.csv and path.csv have them, in the mesh's.
  Vec3 in_mesh(const Vec3& p_R) const;
};

/// Reads surface.vtp, or the last of the steps of a run that did not end; and where they exist
/// boundary.vtp, measurements, waypoints.csv and summary.json. Throws IoError where there is
/// neither surface nor step, or a file is malformed.
Run read_run(const std::filesystem::path& folder);

/// surface.vtp, or the last of the steps where that does not exist; nothing where there is neither.
std::optional<std::filesystem::path> tissue_in(const std::filesystem::path& folder);
/// What run.json says of a run that did not end, by the summary's keys; null where it says nothing.
nlohmann::json begun_in(const std::filesystem::path& folder);
/// Of a surface.vtp, or a step.
Tissue read_tissue(const std::filesystem::path& path);
std::vector<Curve> read_curves(const std::filesystem::path& path);
std::vector<Touch> read_touches(const std::filesystem::path& path);
/// The columns x, y and z of a row. Throws IoError.
Vec3 place_at(const CsvTable& table, std::size_t row);
/// readings_used.csv, or else measurements.csv: where a plan's or a boundary's own exists, the
/// measurements beside it are what it was given.
std::filesystem::path touches_in(const std::filesystem::path& folder);

}  // namespace palpation::results
