#include "geometry/unfold.h"

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

namespace palpation {
namespace {

constexpr double kAgreement = 1e-9;  // of an edge's length

/// Where the third corner lies for whoever walks from the first to the second: how far ahead, and
/// how far to the left.
Vec2 third_corner(const Vec3& from, const Vec3& to, const Vec3& third) {
  const Vec3 ahead = (to - from).normalized(), arm = third - from;
  return {ahead.dot(arm), ahead.cross(arm).norm()};
}

}  // namespace

std::optional<Points2> unfold(const TriangleMesh& mesh, const Triangles& neighbours) {
  const auto corner = [&](int face, int i) { return mesh.triangles(face, i % 3); };
  const auto position = [&](int vertex) { return Vec3(mesh.vertices.row(vertex)); };
  const auto agrees = [](double length, double expected) {
    return std::abs(length - expected) <= kAgreement * expected;
  };

  Points2 uv = Points2::Zero(mesh.vertices.rows(), 2);
  std::vector<bool> placed(mesh.vertices.rows(), false), reached(mesh.triangles.rows(), false);
  uv(corner(0, 1), 0) = (position(corner(0, 1)) - position(corner(0, 0))).norm();
  placed[corner(0, 0)] = placed[corner(0, 1)] = true;
  // Faces in the order in which they are reached, each with the corner that starts the edge across
  // which it was: nearest first, so that roundings add up over few of them.
  std::vector<std::pair<int, int>> order = {{0, 0}};
  reached[0] = true;
  for (std::size_t next = 0; next < order.size(); ++next) {
    const auto [face, side] = order[next];
    const int a = corner(face, side), b = corner(face, side + 1), c = corner(face, side + 2);
    if (!placed[c]) {
      const Vec2 from = uv.row(a), ahead = (uv.row(b) - uv.row(a)).normalized();
      const Vec2 along = third_corner(position(a), position(b), position(c));
      uv.row(c) = from + along.x() * ahead + along.y() * Vec2(-ahead.y(), ahead.x());
      placed[c] = true;
    }
    if (!agrees((uv.row(c) - uv.row(a)).norm(), (position(c) - position(a)).norm()) ||
        !agrees((uv.row(c) - uv.row(b)).norm(), (position(c) - position(b)).norm()))
      return std::nullopt;
    for (int i = 0; i < 3; ++i) {
      const int across = neighbours(face, i);
      if (across < 0 || reached[across]) continue;
      reached[across] = true;
      int start = 0;
      while (corner(across, start) != corner(face, i + 1)) ++start;
      order.emplace_back(across, start);
    }
  }
  for (int face = 0; face < mesh.triangles.rows(); ++face) {
    const Vec2 ab = uv.row(corner(face, 1)) - uv.row(corner(face, 0)),
               ac = uv.row(corner(face, 2)) - uv.row(corner(face, 0));
    if (!(ab.x() * ac.y() - ab.y() * ac.x() > 0.0)) return std::nullopt;
  }
  return uv;
}

}  // namespace palpation
