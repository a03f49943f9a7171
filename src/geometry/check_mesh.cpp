#include "geometry/check_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <span>
#include <string>

#include "geometry/half_edges.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

// Half-edges are numbered by int.
constexpr Eigen::Index kMostElements = std::numeric_limits<int>::max() / 6;
// Squares of areas must be numbers: 1e-60 leaves room for faces of a millionth of the diameter.
constexpr double kLeastDiameter = 1e-60;
constexpr double kLargestDiameter = 1e60;
// Rounding of the cross product of two edges, relative to the longest edge's square: what is below
// has no normal.
constexpr double kNoArea = 4.0 * std::numeric_limits<double>::epsilon();

std::string text_of_place(const Vec3& place) {
  std::string text = "(";
  return text.append(text_of(place.x()))
      .append(", ")
      .append(text_of(place.y()))
      .append(", ")
      .append(text_of(place.z()))
      .append(")");
}

std::string name_of_vertex(const TriangleMesh& mesh, Eigen::Index vertex) {
  return "vertex " + std::to_string(vertex) + " at " + text_of_place(mesh.vertices.row(vertex));
}

std::string name_of_triangle(const TriangleMesh& mesh, Eigen::Index face) {
  const auto t = mesh.triangles.row(face);
  return "triangle " + std::to_string(face) + " of vertices " + std::to_string(t[0]) + ", " +
         std::to_string(t[1]) + ", " + std::to_string(t[2]);
}

std::string name_of_placed_triangle(const TriangleMesh& mesh, Eigen::Index face) {
  Vec3 centre = Vec3::Zero();
  for (int i = 0; i < 3; ++i)
    centre += mesh.vertices.row(mesh.triangles(face, i)).transpose() / 3.0;
  return name_of_triangle(mesh, face) + " at " + text_of_place(centre);
}

std::string name_of_edge(const TriangleMesh& mesh, int a, int b) {
  const Vec3 middle = 0.5 * (mesh.vertices.row(a) + mesh.vertices.row(b));
  return "edge between vertices " + std::to_string(std::min(a, b)) + " and " +
         std::to_string(std::max(a, b)) + " at " + text_of_place(middle);
}

[[noreturn]] void refuse(const std::string& element, const std::string& rule) {
  throw InvalidMesh("Surface: " + element + " " + rule);
}

void check_size(const TriangleMesh& mesh) {
  if (mesh.triangles.rows() == 0)
    refuse("a mesh of " + std::to_string(mesh.vertices.rows()) + " vertices",
           "must have at least one triangle");
  if (mesh.triangles.rows() > kMostElements || mesh.vertices.rows() > kMostElements) {
    refuse("a mesh of " + std::to_string(mesh.triangles.rows()) + " triangles",
           "must have at most " + std::to_string(kMostElements));
  }
}

void check_vertices(const TriangleMesh& mesh) {
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    if (!mesh.vertices.row(v).allFinite())
      refuse(name_of_vertex(mesh, v), "must have finite coordinates");
  }
}

void check_indices(const TriangleMesh& mesh) {
  const Eigen::Index count = mesh.vertices.rows();
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    for (int i = 0; i < 3; ++i) {
      const int vertex = mesh.triangles(f, i);
      if (vertex >= 0 && vertex < count) continue;
      refuse(name_of_triangle(mesh, f),
             "must only use vertices that exist, 0 to " + std::to_string(count - 1));
    }
  }
}

void check_scale(const TriangleMesh& mesh) {
  const Vec3 sides = mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff();
  const double diameter = sides.stableNorm();
  if (diameter != 0.0 && !(diameter >= kLeastDiameter && diameter <= kLargestDiameter)) {
    refuse("a mesh of diameter " + text_of(diameter) + " m",
           "must be between 1e-60 and 1e60 m across, or its areas are no numbers");
  }
}

void check_shape(const TriangleMesh& mesh, Eigen::Index face) {
  const Eigen::Vector3i t = mesh.triangles.row(face);
  if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
    refuse(name_of_placed_triangle(mesh, face), "must have three different vertices");
  const Vec3 a = mesh.vertices.row(t[0]), b = mesh.vertices.row(t[1]), c = mesh.vertices.row(t[2]);
  if (a == b || b == c || c == a) {
    refuse(name_of_placed_triangle(mesh, face),
           "must have no edge of zero length: two of its vertices are in one place");
  }
  if (!has_area(mesh, face))
    refuse(name_of_placed_triangle(mesh, face), "must have an area: its vertices are on one line");
}

std::vector<int> lowest_faces(const TriangleMesh& mesh) {
  std::vector<int> face_of_vertex(mesh.vertices.rows(), -1);
  for (Eigen::Index f = mesh.triangles.rows() - 1; f >= 0; --f) {
    for (int i = 0; i < 3; ++i) face_of_vertex[mesh.triangles(f, i)] = static_cast<int>(f);
  }
  for (std::size_t v = 0; v < face_of_vertex.size(); ++v) {
    if (face_of_vertex[v] < 0)
      refuse(name_of_vertex(mesh, static_cast<Eigen::Index>(v)), "must be used by a triangle");
  }
  return face_of_vertex;
}

std::string list_of_faces(std::span<const int> half_edges) {
  std::string list;
  for (std::size_t k = 0; k < half_edges.size(); ++k) {
    if (k == 8) return list + ", ...";
    list += (k == 0 ? "" : ", ") + std::to_string(half_edges[k] / 3);
  }
  return list;
}

Triangles pair_up_edges(const TriangleMesh& mesh) {
  const Triangles& triangles = mesh.triangles;
  const EdgeTable edges(triangles, static_cast<int>(mesh.vertices.rows()));
  Triangles neighbours = Triangles::Constant(triangles.rows(), 3, -1);
  for (int e = 0; e < edges.size(); ++e) {
    const std::span<const int> pair = edges.half_edges(e);
    if (pair.size() == 1) continue;
    const int start = half_edge_start(triangles, pair[0]), end = half_edge_end(triangles, pair[0]);
    if (pair.size() > 2) {
      refuse(name_of_edge(mesh, start, end), "must be in one or two triangles, and is in " +
                                                 std::to_string(pair.size()) + ": " +
                                                 list_of_faces(pair));
    }
    if (half_edge_start(triangles, pair[1]) == start) {
      refuse(name_of_edge(mesh, start, end),
             "must be run through in opposite directions by its two triangles, " +
                 list_of_faces(pair) +
                 ": one of them is turned round, or the surface has one side only");
    }
    neighbours(pair[0] / 3, pair[0] % 3) = pair[1] / 3;
    neighbours(pair[1] / 3, pair[1] % 3) = pair[0] / 3;
  }
  return neighbours;
}

int corner_of(const Triangles& triangles, int face, int vertex) {
  if (triangles(face, 0) == vertex) return 0;
  return triangles(face, 1) == vertex ? 1 : 2;
}

/// How many triangles a walk around the vertex meets that starts in a face and crosses edges that
/// end there. `edge_offset` 2 turns counter-clockwise (over the edge that comes in at the vertex),
/// 0 clockwise.
int walk_around(const Triangles& triangles, const Triangles& neighbours, int vertex, int start,
                int edge_offset, bool& closed) {
  int met = 0;
  int face = start;
  do {
    ++met;
    face = neighbours(face, (corner_of(triangles, face, vertex) + edge_offset) % 3);
  } while (face >= 0 && face != start);
  closed = face == start;
  return met;
}

int fan_size(const Triangles& triangles, const Triangles& neighbours, int vertex, int start) {
  bool closed = false;
  const int met = walk_around(triangles, neighbours, vertex, start, 2, closed);
  if (closed) return met;
  return met + walk_around(triangles, neighbours, vertex, start, 0, closed) - 1;
}

void check_fans(const TriangleMesh& mesh, const Connectivity& connectivity) {
  std::vector<int> degree(mesh.vertices.rows(), 0);
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    for (int i = 0; i < 3; ++i) ++degree[mesh.triangles(f, i)];
  }
  for (int v = 0; v < mesh.vertices.rows(); ++v) {
    const int fan =
        fan_size(mesh.triangles, connectivity.neighbours, v, connectivity.face_of_vertex[v]);
    if (fan == degree[v]) continue;
    refuse(name_of_vertex(mesh, v), "must have its triangles in one fan: of " +
                                        std::to_string(degree[v]) + ", only " +
                                        std::to_string(fan) + " hang together with triangle " +
                                        std::to_string(connectivity.face_of_vertex[v]));
  }
}

}  // namespace

bool has_area(const TriangleMesh& mesh, Eigen::Index face) {
  const Eigen::Vector3i t = mesh.triangles.row(face);
  return has_area(mesh.vertices.row(t[0]), mesh.vertices.row(t[1]), mesh.vertices.row(t[2]));
}

bool has_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest_squared =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return (b - a).cross(c - a).norm() > kNoArea * longest_squared;
}

Connectivity check_mesh(const TriangleMesh& mesh) {
  check_size(mesh);
  check_vertices(mesh);
  check_indices(mesh);
  check_scale(mesh);
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) check_shape(mesh, f);
  Connectivity connectivity;
  connectivity.face_of_vertex = lowest_faces(mesh);
  connectivity.neighbours = pair_up_edges(mesh);
  check_fans(mesh, connectivity);
  return connectivity;
}

}  // namespace palpation
