#include "geometry/trim.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "geometry/half_edges.h"

namespace palpation {
namespace {

constexpr double kLeastPatch = 0.05;  // of the largest patch's area

struct Corners {
  Vec3 a, b, c;
  double area() const { return 0.5 * (b - a).cross(c - a).norm(); }
};

Corners corners_of(const TriangleMesh& mesh, Eigen::Index face) {
  return {mesh.vertices.row(mesh.triangles(face, 0)), mesh.vertices.row(mesh.triangles(face, 1)),
          mesh.vertices.row(mesh.triangles(face, 2))};
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Things in groups that hang together.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  void join(int a, int b) { parent_[static_cast<std::size_t>(of(a))] = of(b); }
  int of(int thing) {
    while (parent_[static_cast<std::size_t>(thing)] != thing) {
      int& parent = parent_[static_cast<std::size_t>(thing)];
      parent = parent_[static_cast<std::size_t>(parent)];
      thing = parent;
    }
    return thing;
  }

 private:
  std::vector<int> parent_;
};

Vec3 vector_area(const TriangleMesh& mesh, Eigen::Index face) {
  const Corners t = corners_of(mesh, face);
  return 0.5 * (t.b - t.a).cross(t.c - t.a);
}

/// Whether the two triangles at an edge are folded by more than a right angle.
bool is_fold(const TriangleMesh& mesh, std::span<const int> sides) {
  return sides.size() == 2 &&
         vector_area(mesh, sides[0] / 3).dot(vector_area(mesh, sides[1] / 3)) < 0.0;
}

/// Of triangles that hang together by edges which are no folds.
Groups patches_of(const TriangleMesh& mesh, Folds folds) {
  Groups groups(static_cast<std::size_t>(mesh.triangles.rows()));
  const EdgeTable edges(mesh.triangles, static_cast<int>(mesh.vertices.rows()));
  for (int edge = 0; edge < edges.size(); ++edge) {
    const auto sides = edges.half_edges(edge);
    if (sides.size() == 2 && !(folds == Folds::Part && is_fold(mesh, sides)))
      groups.join(sides[1] / 3, sides[0] / 3);
  }
  return groups;
}

Triangles only(const Triangles& triangles, const std::vector<bool>& keep) {
  Triangles kept(std::count(keep.begin(), keep.end(), true), 3);
  Eigen::Index count = 0;
  for (Eigen::Index face = 0; face < triangles.rows(); ++face) {
    if (keep[static_cast<std::size_t>(face)]) kept.row(count++) = triangles.row(face);
  }
  return kept;
}

/// Drops the lesser ones of groups of faces, by their area.
void drop_small_patches(TriangleMesh& mesh, Folds folds) {
  Groups patches = patches_of(mesh, folds);
  std::map<int, double> area;
  for (Eigen::Index face = 0; face < mesh.triangles.rows(); ++face)
    area[patches.of(static_cast<int>(face))] += corners_of(mesh, face).area();
  double largest = 0.0;
  for (const auto& [patch, size] : area) largest = std::max(largest, size);
  std::vector<bool> keep(static_cast<std::size_t>(mesh.triangles.rows()));
  for (std::size_t face = 0; face < keep.size(); ++face)
    keep[face] = area[patches.of(static_cast<int>(face))] >= kLeastPatch * largest;
  mesh.triangles = only(mesh.triangles, keep);
}

/// Of the fans at a vertex the largest stays. False where every vertex had one.
bool drop_pinches(TriangleMesh& mesh, Folds folds) {
  const int vertex_count = static_cast<int>(mesh.vertices.rows());
  Groups fans(static_cast<std::size_t>(mesh.triangles.size()));
  const EdgeTable edges(mesh.triangles, vertex_count);
  const auto corner_at = [&](int half_edge, int vertex) {
    return half_edge_start(mesh.triangles, half_edge) == vertex
               ? half_edge
               : half_edge / 3 * 3 + (half_edge + 1) % 3;
  };
  for (int edge = 0; edge < edges.size(); ++edge) {
    const auto sides = edges.half_edges(edge);
    if (folds == Folds::Part && is_fold(mesh, sides)) continue;
    for (std::size_t side = 1; side < sides.size(); ++side) {
      for (const int end :
           {half_edge_start(mesh.triangles, sides[0]), half_edge_end(mesh.triangles, sides[0])})
        fans.join(corner_at(sides[0], end), corner_at(sides[side], end));
    }
  }
  std::vector<std::map<int, double>> area(static_cast<std::size_t>(vertex_count));
  for (int corner = 0; corner < mesh.triangles.size(); ++corner)
    area[static_cast<std::size_t>(mesh.triangles(corner / 3, corner % 3))][fans.of(corner)] +=
        corners_of(mesh, corner / 3).area();
  std::vector<bool> keep(static_cast<std::size_t>(mesh.triangles.rows()), true);
  for (int corner = 0; corner < mesh.triangles.size(); ++corner) {
    const auto& sizes = area[static_cast<std::size_t>(mesh.triangles(corner / 3, corner % 3))];
    const auto less = [](const auto& a, const auto& b) { return a.second < b.second; };
    if (std::max_element(sizes.begin(), sizes.end(), less)->first != fans.of(corner))
      keep[static_cast<std::size_t>(corner / 3)] = false;
  }
  mesh.triangles = only(mesh.triangles, keep);
  return static_cast<std::size_t>(mesh.triangles.rows()) < keep.size();
}

std::vector<int> drop_unused_vertices(TriangleMesh& mesh) {
  std::vector<int> number(static_cast<std::size_t>(mesh.vertices.rows()), -1);
  for (const int vertex : mesh.triangles.reshaped()) number[static_cast<std::size_t>(vertex)] = 0;
  std::vector<int> kept;
  for (std::size_t vertex = 0; vertex < number.size(); ++vertex) {
    if (number[vertex] < 0) continue;
    number[vertex] = static_cast<int>(kept.size());
    kept.push_back(static_cast<int>(vertex));
  }
  for (int& vertex : mesh.triangles.reshaped()) vertex = number[static_cast<std::size_t>(vertex)];
  mesh.vertices = Points(mesh.vertices(kept, Eigen::all));
  return kept;
}

}  // namespace

Field circle_widths(const TriangleMesh& mesh) {
  Field widths(mesh.triangles.rows());
  for (Eigen::Index face = 0; face < widths.size(); ++face) {
    const Corners t = corners_of(mesh, face);
    const double sides = (t.b - t.a).norm() * (t.c - t.b).norm() * (t.a - t.c).norm();
    const double area = t.area();
    widths[face] = area > 0.0 ? 0.5 * sides / area : std::numeric_limits<double>::infinity();
  }
  return widths;
}

double sample_spacing(const TriangleMesh& mesh) {
  const Field widths = circle_widths(mesh);
  std::vector<std::vector<double>> around(static_cast<std::size_t>(mesh.vertices.rows()));
  for (Eigen::Index face = 0; face < widths.size(); ++face) {
    for (int i = 0; i < 3; ++i)
      around[static_cast<std::size_t>(mesh.triangles(face, i))].push_back(widths[face]);
  }
  std::vector<double> medians;
  for (std::vector<double>& each : around) {
    if (!each.empty()) medians.push_back(median(each));
  }
  return medians.empty() ? 0.0 : median(medians) / std::numbers::sqrt2;
}

Trimmed trim(const TriangleMesh& mesh, double most_m, Folds folds) {
  const Field widths = circle_widths(mesh);
  std::vector<bool> keep(static_cast<std::size_t>(widths.size()));
  for (std::size_t face = 0; face < keep.size(); ++face)
    keep[face] = widths[static_cast<Eigen::Index>(face)] <= most_m;
  Trimmed result{{mesh.vertices, only(mesh.triangles, keep)}, {}};
  do drop_small_patches(result.mesh, folds);
  while (drop_pinches(result.mesh, folds));
  result.kept = drop_unused_vertices(result.mesh);
  return result;
}

void face_outward(TriangleMesh& mesh, const Points& outward) {
  constexpr double kClear = 0.1;  // of the area, that at least faces one way
  struct Sums {
    double along = 0.0, area = 0.0, volume = 0.0;
  };
  Groups groups = patches_of(mesh, Folds::Keep);
  const Vec3 origin = mesh.vertices.colwise().mean();
  std::map<int, Sums> sums;
  for (Eigen::Index face = 0; face < mesh.triangles.rows(); ++face) {
    const Corners t = corners_of(mesh, face);
    const Vec3 vector = vector_area(mesh, face);
    Vec3 direction = Vec3::Zero();
    for (int i = 0; i < 3; ++i) direction += outward.row(mesh.triangles(face, i)).normalized();
    Sums& of = sums[groups.of(static_cast<int>(face))];
    of.along += vector.dot(direction) / 3.0;
    of.area += vector.norm();
    of.volume += vector.dot(t.a - origin);
  }
  for (Eigen::Index face = 0; face < mesh.triangles.rows(); ++face) {
    const Sums& of = sums[groups.of(static_cast<int>(face))];
    const double side = std::abs(of.along) > kClear * of.area ? of.along : of.volume;
    if (side < 0.0) std::swap(mesh.triangles(face, 1), mesh.triangles(face, 2));
  }
}

}  // namespace palpation
