#include <Eigen/Geometry>
#include <charconv>
#include <cmath>

#include "io/byte_order.h"
#include "io/length_scale.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "palpation/io/read_mesh.h"

namespace palpation {
namespace {

/// Vertices in the unit, and the triangles that were checked to point at them.
struct ScaledMesh {
  Points vertices;
  const Triangles& triangles;
};

void append_number(std::string& text, double value) {
  char digits[32];
  const auto [end, status] = std::to_chars(digits, digits + sizeof digits, value);
  text.append(digits, end);
}

void append_vertex(std::string& text, const ScaledMesh& mesh, Eigen::Index vertex) {
  for (int i = 0; i < 3; ++i) {
    if (i > 0) text += ' ';
    append_number(text, mesh.vertices(vertex, i));
  }
  text += '\n';
}

void append_triangle(std::string& text, const ScaledMesh& mesh, Eigen::Index triangle, int first) {
  for (int i = 0; i < 3; ++i)
    text.append(" ").append(std::to_string(mesh.triangles(triangle, i) + first));
  text += '\n';
}

/// height_sd: of each vertex, in the unit; or none.
std::string ply_of(const ScaledMesh& mesh, const std::string& comments = "",
                   const Field& height_sd = {}) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\n" + comments + "element vertex " +
                      std::to_string(mesh.vertices.rows()) +
                      "\nproperty double x\nproperty double y\nproperty double z\n" +
                      (height_sd.size() > 0 ? "property double height_sd\n" : "") +
                      "element face " + std::to_string(mesh.triangles.rows()) +
                      "\nproperty list uchar int vertex_indices\nend_header\n";
  bytes.reserve(bytes.size() + 24 * static_cast<std::size_t>(mesh.vertices.rows()) +
                13 * static_cast<std::size_t>(mesh.triangles.rows()));
  for (Eigen::Index vertex = 0; vertex < mesh.vertices.rows(); ++vertex) {
    for (int i = 0; i < 3; ++i) append_little_endian(bytes, mesh.vertices(vertex, i));
    if (height_sd.size() > 0) append_little_endian(bytes, height_sd[vertex]);
  }
  for (Eigen::Index triangle = 0; triangle < mesh.triangles.rows(); ++triangle) {
    bytes += '\3';
    for (int i = 0; i < 3; ++i) append_little_endian(bytes, mesh.triangles(triangle, i));
  }
  return bytes;
}

std::string obj_of(const ScaledMesh& mesh) {
  // The only counts that an OBJ file can have, by which a reader may see that it was cut.
  std::string text = "# " + std::to_string(mesh.vertices.rows()) + " vertices, " +
                     std::to_string(mesh.triangles.rows()) + " faces\n";
  for (Eigen::Index vertex = 0; vertex < mesh.vertices.rows(); ++vertex)
    append_vertex(text += "v ", mesh, vertex);
  for (Eigen::Index triangle = 0; triangle < mesh.triangles.rows(); ++triangle)
    append_triangle(text += "f", mesh, triangle, 1);
  return text;
}

std::string off_of(const ScaledMesh& mesh) {
  std::string text = "OFF\n" + std::to_string(mesh.vertices.rows()) + " " +
                     std::to_string(mesh.triangles.rows()) + " 0\n";
  for (Eigen::Index vertex = 0; vertex < mesh.vertices.rows(); ++vertex)
    append_vertex(text, mesh, vertex);
  for (Eigen::Index triangle = 0; triangle < mesh.triangles.rows(); ++triangle)
    append_triangle(text += "3", mesh, triangle, 0);
  return text;
}

void append_floats(std::string& bytes, const Vec3& vector) {
  for (int i = 0; i < 3; ++i) append_little_endian(bytes, static_cast<float>(vector[i]));
}

std::string stl_of(const ScaledMesh& mesh) {
  std::string bytes(80, ' ');
  append_little_endian(bytes, static_cast<std::uint32_t>(mesh.triangles.rows()));
  for (Eigen::Index triangle = 0; triangle < mesh.triangles.rows(); ++triangle) {
    const auto corner = [&](int i) -> Vec3 {
      return mesh.vertices.row(mesh.triangles(triangle, i));
    };
    append_floats(bytes, (corner(1) - corner(0)).cross(corner(2) - corner(0)).stableNormalized());
    for (int i = 0; i < 3; ++i) append_floats(bytes, corner(i));
    bytes.append(2, '\0');
  }
  return bytes;
}

ScaledMesh scaled(const TriangleMesh& mesh, LengthUnit unit) {
  require(mesh.vertices.allFinite(), "write_mesh", "mesh", "must have finite vertices");
  const bool in_range =
      mesh.triangles.size() == 0 ||
      (mesh.triangles.minCoeff() >= 0 && mesh.triangles.maxCoeff() < mesh.vertices.rows());
  require(in_range, "write_mesh", "mesh", "must have triangles that point at its vertices");
  return {mesh.vertices.unaryExpr([unit](double value_m) { return from_metres(value_m, unit); }),
          mesh.triangles};
}

}  // namespace

void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh, LengthUnit unit) {
  const ScaledMesh in_unit = scaled(mesh, unit);
  const std::string extension = path.extension().string();
  if (extension == ".ply") return write_atomically(path, ply_of(in_unit));
  if (extension == ".obj") return write_atomically(path, obj_of(in_unit));
  if (extension == ".off") return write_atomically(path, off_of(in_unit));
  if (extension == ".stl") return write_atomically(path, stl_of(in_unit));
  throw InvalidInput("write_mesh: " + path.string() + " must end with .ply, .obj, .off or .stl");
}

void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh, LengthUnit unit,
                const Field& height_sd) {
  require(path.extension() == ".ply", "write_mesh", path.string(),
          "must end with .ply: no other format has a place for height_sd");
  require(height_sd.size() == mesh.vertices.rows() && height_sd.allFinite() &&
              (height_sd.array() >= 0.0).all(),
          "write_mesh", "height_sd", "must have a number that is not negative for each vertex");
  const std::string name = name_of(unit);
  const Field in_unit =
      height_sd.unaryExpr([unit](double value_m) { return from_metres(value_m, unit); });
  write_atomically(path, ply_of(scaled(mesh, unit),
                                "comment unit " + name +
                                    "\ncomment height_sd: standard deviation of the height along "
                                    "the normal, " +
                                    name + "\n",
                                in_unit));
}

}  // namespace palpation
