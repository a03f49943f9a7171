// mesh: phantoms.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <string>

#include "palpation/base/error.h"
#include "palpation/geometry/make_phantom.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/io/recording.h"
#include "scene/exit_code.h"
#include "scene/mesh_words.h"
#include "tool/commands.h"
#include "tool/mesh_file.h"

namespace palpation::tool {
namespace {

[[noreturn]] void refuse(const MeshArguments& arguments, const std::string& words) {
  throw WrongUsage("mesh " + arguments.kind + ": " + words);
}

constexpr double kMostVertices = 16e6;
constexpr double kRounding = 1e-9;  // of a count of cells: 0.3 / 0.1 is a little over 3
constexpr int kVertices = 200;      // of a plane along each side, where they are not given

Vec2 size_mm_of(const MeshArguments& arguments) {
  const std::vector<double>& given = arguments.size_mm;
  return given.empty() ? Vec2(25.0, 50.0) : Vec2(given[0], given[1]);
}

double edge_mm_of(const MeshArguments& arguments) { return arguments.edge_mm.value_or(0.5); }

constexpr double kLeastCells = 4.0;  // across a shape, or it would not be that shape
constexpr double kSteepest =
    100.0 / (2.0 * std::numbers::pi);  // amplitude over wavelength: 100 is the greatest slope

void check_count(double vertices, const MeshArguments& arguments) {
  if (vertices > kMostVertices)
    refuse(arguments, "--edge-mm " + text_of(edge_mm_of(arguments)) + " would take " +
                          text_of(std::round(vertices * 1e-6)) +
                          " million vertices, but at most 16 million are made: take longer edges");
}

/// As few cells as are no longer than asked for, but for rounding.
void take_cells(PlaneOptions& options, const MeshArguments& arguments) {
  const Vec2 cells =
      (options.size_m * 1000.0 / edge_mm_of(arguments) * (1.0 - kRounding)).array().ceil();
  check_count((cells.x() + 1.0) * (cells.y() + 1.0), arguments);
  options.columns = static_cast<int>(cells.x()) + 1;
  options.rows = static_cast<int>(cells.y()) + 1;
}

TriangleMesh plane_of(const MeshArguments& arguments) {
  PlaneOptions options{.jitter = arguments.jitter};
  if (arguments.around.empty()) {
    options.size_m = size_mm_of(arguments) / 1000.0;
    options.columns = arguments.vertices.empty() ? kVertices : arguments.vertices[0];
    options.rows = arguments.vertices.empty() ? kVertices : arguments.vertices[1];
    if (arguments.edge_mm) take_cells(options, arguments);
  } else {
    const RecordedReadings recording = read_recording(arguments.around);
    const Vec2 margin = Vec2::Constant(arguments.margin_mm / 1000.0);
    options.corner_m = recording.positions.leftCols<2>().colwise().minCoeff().transpose() - margin;
    options.size_m = recording.positions.leftCols<2>().colwise().maxCoeff().transpose() + margin -
                     options.corner_m;
    take_cells(options, arguments);
  }
  Random random(arguments.seed);
  return make_plane(options, random);
}

void take_mm(double& length_m, const std::optional<double>& given_mm) {
  if (given_mm) length_m = *given_mm / 1000.0;
}

Sheet sheet_of(const MeshArguments& arguments) {
  const Vec2 size_m = size_mm_of(arguments) / 1000.0;
  if (arguments.kind == "cylinder") {
    CylinderOptions options{.size_m = size_m};
    take_mm(options.radius_m, arguments.radius_mm);
    return cylinder_sheet(options);
  }
  if (arguments.kind == "dome") {
    DomeOptions options;
    take_mm(options.radius_m, arguments.radius_mm);
    take_mm(options.reach_m, arguments.reach_mm);
    return dome_sheet(options);
  }
  if (arguments.kind == "saddle") {
    SaddleOptions options{.size_m = size_m};
    take_mm(options.radius_m, arguments.radius_mm);
    return saddle_sheet(options);
  }
  if (arguments.kind == "wave") {
    WaveOptions options{.size_m = size_m};
    take_mm(options.amplitude_m, arguments.amplitude_mm);
    take_mm(options.wavelength_m, arguments.wavelength_mm);
    return wave_sheet(options);
  }
  FoldedOptions options;
  take_mm(options.gap_m, arguments.gap_mm);
  take_mm(options.flank_m, arguments.flank_mm);
  if (!arguments.size_mm.empty()) options.width_m = size_m.y();
  return folded_sheet(options);
}

/// What a kind of phantom does not have is refused, not left without effect.
void check_options(const MeshArguments& arguments) {
  const auto is_one_of = [&](std::initializer_list<const char*> kinds) {
    return std::any_of(kinds.begin(), kinds.end(),
                       [&](const char* kind) { return arguments.kind == kind; });
  };
  const auto check = [&](const char* option, bool given, bool belongs) {
    if (given && !belongs) refuse(arguments, std::string(option) + " is not among its options");
  };
  check("--around", !arguments.around.empty(), is_one_of({"plane"}));
  check("--vertices", !arguments.vertices.empty(), is_one_of({"plane"}));
  check("--size-mm", !arguments.size_mm.empty(), !is_one_of({"dome"}));
  check("--radius-mm", arguments.radius_mm.has_value(), is_one_of({"cylinder", "dome", "saddle"}));
  check("--reach-mm", arguments.reach_mm.has_value(), is_one_of({"dome"}));
  check("--amplitude-mm", arguments.amplitude_mm.has_value(), is_one_of({"wave"}));
  check("--wavelength-mm", arguments.wavelength_mm.has_value(), is_one_of({"wave"}));
  check("--gap-mm", arguments.gap_mm.has_value(), is_one_of({"folded"}));
  check("--flank-mm", arguments.flank_mm.has_value(), is_one_of({"folded"}));
}

/// What the shapes ask of their sizes, in the words of the options.
void check_sizes(const MeshArguments& arguments) {
  constexpr double kPi = std::numbers::pi;
  const auto at_most = [&](const std::string& option, double value_mm, double most_mm,
                           const std::string& why) {
    if (value_mm >= most_mm)
      refuse(arguments, option + " " + text_of(value_mm) + " must be less than " +
                            text_of(most_mm) + ", " + why);
  };
  if (arguments.kind == "cylinder") {
    const double radius_mm = arguments.radius_mm.value_or(CylinderOptions().radius_m * 1000.0);
    at_most("--size-mm", size_mm_of(arguments).x(), 2.0 * kPi * radius_mm,
            "once around a cylinder of --radius-mm " + text_of(radius_mm));
  }
  if (arguments.kind == "dome") {
    const double radius_mm = arguments.radius_mm.value_or(DomeOptions().radius_m * 1000.0);
    at_most("--reach-mm", arguments.reach_mm.value_or(DomeOptions().reach_m * 1000.0),
            kPi * radius_mm, "half way around a sphere of --radius-mm " + text_of(radius_mm));
  }
  if (arguments.kind == "wave") {
    const double wavelength_mm =
        arguments.wavelength_mm.value_or(WaveOptions().wavelength_m * 1000.0);
    at_most("--amplitude-mm", arguments.amplitude_mm.value_or(WaveOptions().amplitude_m * 1000.0),
            kSteepest * wavelength_mm,
            "as steep as --wavelength-mm " + text_of(wavelength_mm) + " allows");
  }
}

TriangleMesh curved_of(const MeshArguments& arguments) {
  check_sizes(arguments);
  const Sheet sheet = sheet_of(arguments);
  const double edge_m = edge_mm_of(arguments) / 1000.0;
  const Vec2 cells = sheet.size_m / edge_m;
  check_count((cells.x() + 1.0) * (cells.y() + 1.0), arguments);
  if (cells.minCoeff() < kLeastCells)
    refuse(arguments, "--edge-mm " + text_of(edge_mm_of(arguments)) + " is too long for what is " +
                          text_of(sheet.size_m.minCoeff() * 1000.0) +
                          " mm wide: take at most a quarter of that");
  Random random(arguments.seed);
  return make_phantom(sheet, edge_m, arguments.jitter, random).mesh;
}

}  // namespace

std::vector<std::string> mesh_kinds() {
  return {"plane", "cylinder", "dome", "saddle", "wave", "folded"};
}

void make_mesh(const MeshArguments& arguments) {
  check_options(arguments);
  const TriangleMesh mesh = arguments.kind == "plane" ? plane_of(arguments) : curved_of(arguments);
  write_mesh_file(arguments.output, mesh, length_unit(arguments.unit), {},
                  arguments.overwrite ? Existing::Replaced : Existing::Kept);
  std::printf("%s: %ld vertices, %ld triangles, %s\n", arguments.output.string().c_str(),
              static_cast<long>(mesh.vertices.rows()), static_cast<long>(mesh.triangles.rows()),
              size_words(mesh).c_str());
}

}  // namespace palpation::tool
