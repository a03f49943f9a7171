// info, mesh: commands on meshes alone.
#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>

#include "palpation/base/error.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/geometry/surface.h"
#include "palpation/io/read_mesh.h"
#include "palpation/io/recording.h"
#include "tool/commands.h"
#include "tool/words.h"

namespace palpation::tool {
namespace {

constexpr double kLeastExtent_m = 1e-3;
constexpr double kMostExtent_m = 2.0;

struct Edges {
  double shortest = 0.0, mean = 0.0, longest = 0.0;
};

Edges edges_of(const TriangleMesh& mesh) {
  Edges edges{1e300, 0.0, 0.0};
  for (Eigen::Index face = 0; face < mesh.triangles.rows(); ++face) {
    for (int corner = 0; corner < 3; ++corner) {
      const double length =
          (mesh.vertices.row(mesh.triangles(face, corner)) - mesh.vertices.row(mesh.triangles(face, (corner + 1) % 3))).norm();
      edges.shortest = std::min(edges.shortest, length);
      edges.longest = std::max(edges.longest, length);
      edges.mean += length / (3.0 * static_cast<double>(mesh.triangles.rows()));
    }
  }
  return edges;
}

/// Gaussian curvature at inner vertices, by angle defect over area: its extremes in 1/mm2.
std::pair<double, double> curvature_range(const Surface& surface) {
  Field defect = Field::Constant(surface.vertex_count(), 2.0 * 3.14159265358979323846);
  for (int face = 0; face < surface.face_count(); ++face) {
    const Eigen::Vector3i corners = surface.triangle(face);
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3 p = surface.vertex(corners[corner]);
      const Vec3 a = surface.vertex(corners[(corner + 1) % 3]) - p;
      const Vec3 b = surface.vertex(corners[(corner + 2) % 3]) - p;
      defect[corners[corner]] -= std::atan2(a.cross(b).norm(), a.dot(b));
    }
  }
  for (const auto& loop : surface.border_loops()) {
    for (int vertex : loop) defect[vertex] = 0.0;
  }
  const Field curvature = defect.array() / surface.vertex_areas().array() * 1e-6;
  return {curvature.minCoeff(), curvature.maxCoeff()};
}

std::string size_words(const TriangleMesh& mesh) {
  const Vec3 size = (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).transpose() * 1e3;
  return fixed(size.x(), 2) + " x " + fixed(size.y(), 2) + " x " + fixed(size.z(), 2) + " mm";
}

void advise(const Surface& surface) {
  const Topology topology = surface.topology();
  if (surface.is_planar()) {
    std::printf("Flat: its own plane is its chart, and every metric and the boundary's area are exact.\n");
    std::printf("Next: name it as surface.mesh of a scene (palpate help scene) and run palpate simulate or palpate plan.\n");
  } else if (topology.is_closed()) {
    std::printf("Closed: it cannot be laid flat as a whole, so it has no chart.\n");
    std::printf(
        "Next: choose a flat part to work on by surface.patch (centre_mm, radius_mm) in a scene; boundaries are drawn on flat tissue only "
        "so far.\n");
  } else {
    std::printf("Curved: it has no chart of its own, and boundaries are drawn on flat tissue only so far.\n");
    std::printf("Next: choose a flat part by surface.patch (centre_mm, radius_mm) in a scene.\n");
  }
}

}  // namespace

void info(const InfoArguments& arguments) {
  const MeshFile file = read_mesh_of_any_size(arguments.mesh, length_unit(arguments.unit));
  const double extent = extent_m(file.mesh);
  std::printf("%s: %s, %ld vertices, %ld triangles, %s\n", arguments.mesh.string().c_str(), file.format.c_str(),
              static_cast<long>(file.mesh.vertices.rows()), static_cast<long>(file.mesh.triangles.rows()), size_words(file.mesh).c_str());
  if (extent < kLeastExtent_m || extent > kMostExtent_m) {
    std::printf("Implausible size: tissue is between 1 mm and 2 m across. Is --unit right?\n");
  }
  for (const MeshWarning& warning : file.warnings) std::printf("Warning: %s\n  %s\n", warning.text.c_str(), warning.advice.c_str());
  try {
    const Surface surface(file.mesh);
    const Topology topology = surface.topology();
    const Edges edges = edges_of(file.mesh);
    const auto [least, most] = curvature_range(surface);
    std::printf(
        "Surface: %d component%s, %s, Euler number %d, %d handle%s\n", topology.components, topology.components == 1 ? "" : "s",
        topology.is_closed() ? "closed" : (std::to_string(topology.borders) + (topology.borders == 1 ? " border" : " borders")).c_str(),
        topology.euler, topology.handles, topology.handles == 1 ? "" : "s");
    std::printf("Area: %s cm2\n", fixed(surface.area() * 1e4, 3).c_str());
    std::printf("Edges: %s to %s mm, mean %s mm\n", fixed(edges.shortest * 1e3, 3).c_str(), fixed(edges.longest * 1e3, 3).c_str(),
                fixed(edges.mean * 1e3, 3).c_str());
    std::printf("Gaussian curvature: %s to %s per mm2\n", fixed(least, 5).c_str(), fixed(most, 5).c_str());
    if (edges.longest > 0.001) {
      std::printf("Coarse: edges up to %s mm exceed what a probe resolves (about 0.5 mm); set surface.refine_mm.\n",
                  fixed(edges.longest * 1e3, 2).c_str());
    }
    advise(surface);
  } catch (const InvalidMesh& error) {
    std::printf("Not a surface to plan on: %s\nNext: repair it in a mesh editor at that place.\n", error.what());
  }
}

void make_mesh(const MeshArguments& arguments) {
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
  const TriangleMesh mesh = make_plane(options, random);
  write_mesh(arguments.output, mesh, length_unit(arguments.unit));
  std::printf("%s: %ld vertices, %ld triangles, %s\n", arguments.output.string().c_str(), static_cast<long>(mesh.vertices.rows()),
              static_cast<long>(mesh.triangles.rows()), size_words(mesh).c_str());
}

}  // namespace palpation::tool
