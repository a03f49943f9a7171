// mesh: phantoms.
#include <algorithm>
#include <cstdio>
#include <initializer_list>
#include <optional>

#include "palpation/base/error.h"
#include "palpation/geometry/make_phantom.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/io/read_mesh.h"
#include "palpation/io/recording.h"
#include "tool/commands.h"
#include "tool/mesh_words.h"

namespace palpation::tool {
namespace {

TriangleMesh plane_of(const MeshArguments& arguments) {
  PlaneOptions options{.jitter = arguments.jitter};
  if (arguments.around.empty()) {
    options.size_m = Vec2(arguments.size_mm[0], arguments.size_mm[1]) / 1000.0;
    options.columns = arguments.vertices[0];
    options.rows = arguments.vertices[1];
  } else {
    require(arguments.edge_mm > 0.0, "mesh", "--edge-mm " + text_of(arguments.edge_mm), "must be positive");
    const RecordedReadings recording = read_recording(arguments.around);
    const Vec2 margin = Vec2::Constant(arguments.margin_mm / 1000.0);
    options.corner_m = recording.positions.leftCols<2>().colwise().minCoeff().transpose() - margin;
    options.size_m = recording.positions.leftCols<2>().colwise().maxCoeff().transpose() + margin - options.corner_m;
    const Vec2 cells = (options.size_m * 1000.0 / arguments.edge_mm).array().ceil();
    require(cells.maxCoeff() < 1e5, "mesh", "--edge-mm " + text_of(arguments.edge_mm), "is too fine for this recording");
    options.columns = static_cast<int>(cells.x()) + 1;
    options.rows = static_cast<int>(cells.y()) + 1;
  }
  Random random(arguments.seed);
  return make_plane(options, random);
}

void take_mm(double& length_m, const std::optional<double>& given_mm) {
  if (given_mm) length_m = *given_mm / 1000.0;
}

Sheet sheet_of(const MeshArguments& arguments) {
  const Vec2 size_m = Vec2(arguments.size_mm[0], arguments.size_mm[1]) / 1000.0;
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
  if (arguments.gives_size) options.width_m = size_m.y();
  return folded_sheet(options);
}

/// What a kind of phantom does not have is refused, not left without effect.
void check_options(const MeshArguments& arguments) {
  const auto is_one_of = [&](std::initializer_list<const char*> kinds) {
    return std::any_of(kinds.begin(), kinds.end(), [&](const char* kind) { return arguments.kind == kind; });
  };
  const auto check = [&](const char* option, bool given, bool belongs) {
    require(!given || belongs, "mesh " + arguments.kind, option, "is not among its options");
  };
  check("--around", !arguments.around.empty(), is_one_of({"plane"}));
  check("--vertices", arguments.gives_vertices, is_one_of({"plane"}));
  check("--size-mm", arguments.gives_size, !is_one_of({"dome"}));
  check("--radius-mm", arguments.radius_mm.has_value(), is_one_of({"cylinder", "dome", "saddle"}));
  check("--reach-mm", arguments.reach_mm.has_value(), is_one_of({"dome"}));
  check("--amplitude-mm", arguments.amplitude_mm.has_value(), is_one_of({"wave"}));
  check("--wavelength-mm", arguments.wavelength_mm.has_value(), is_one_of({"wave"}));
  check("--gap-mm", arguments.gap_mm.has_value(), is_one_of({"folded"}));
  check("--flank-mm", arguments.flank_mm.has_value(), is_one_of({"folded"}));
}

TriangleMesh curved_of(const MeshArguments& arguments) {
  Random random(arguments.seed);
  return make_phantom(sheet_of(arguments), arguments.edge_mm / 1000.0, arguments.jitter, random).mesh;
}

}  // namespace

std::vector<std::string> mesh_kinds() { return {"plane", "cylinder", "dome", "saddle", "wave", "folded"}; }

void make_mesh(const MeshArguments& arguments) {
  check_options(arguments);
  const TriangleMesh mesh = arguments.kind == "plane" ? plane_of(arguments) : curved_of(arguments);
  write_mesh(arguments.output, mesh, length_unit(arguments.unit));
  std::printf("%s: %ld vertices, %ld triangles, %s\n", arguments.output.string().c_str(), static_cast<long>(mesh.vertices.rows()),
              static_cast<long>(mesh.triangles.rows()), size_words(mesh).c_str());
}

}  // namespace palpation::tool
