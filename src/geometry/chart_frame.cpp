#include "geometry/chart_frame.h"

#include <Eigen/Geometry>
#include <cmath>
#include <tuple>

#include "geometry/plane.h"

namespace palpation {
namespace {

constexpr double kEqual = 1e-9;  // of the mesh's size

Eigen::Index origin_of(const TriangleMesh& mesh) {
  const Eigen::VectorXd distance =
      (mesh.vertices.rowwise() - centroid(mesh).transpose()).rowwise().norm();
  const double near =
      distance.minCoeff() +
      kEqual * (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).norm();
  Eigen::Index origin = -1;
  const auto place = [&](Eigen::Index v) {
    return std::tuple(mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2));
  };
  for (Eigen::Index v = 0; v < distance.size(); ++v) {
    if (distance[v] <= near && (origin < 0 || place(v) < place(origin))) origin = v;
  }
  return origin;
}

struct Corner {
  Eigen::Index face;
  Vec3 b, c;    ///< edges to the next and the last corner
  Vec2 ub, uc;  ///< the same in uv
  double angle;
  Vec3 normal;
};

std::vector<Corner> corners_at(const TriangleMesh& mesh, const Points2& uv, Eigen::Index vertex) {
  std::vector<Corner> corners;
  for (Eigen::Index face = 0; face < mesh.triangles.rows(); ++face) {
    for (int i = 0; i < 3; ++i) {
      if (mesh.triangles(face, i) != vertex) continue;
      const int next = mesh.triangles(face, (i + 1) % 3), last = mesh.triangles(face, (i + 2) % 3);
      Corner corner;
      corner.b = mesh.vertices.row(next) - mesh.vertices.row(vertex);
      corner.c = mesh.vertices.row(last) - mesh.vertices.row(vertex);
      corner.ub = uv.row(next) - uv.row(vertex);
      corner.uc = uv.row(last) - uv.row(vertex);
      const Vec3 area = corner.b.cross(corner.c);
      corner.angle = std::atan2(area.norm(), corner.b.dot(corner.c));
      corner.normal = area.normalized();
      corner.face = face;
      corners.push_back(corner);
    }
  }
  return corners;
}

/// A tangential direction at the corner as it runs in uv.
Vec2 mapped(const Corner& corner, const Vec3& direction) {
  const Vec3 tangential = direction - corner.normal.dot(direction) * corner.normal;
  const double twice_area = corner.normal.dot(corner.b.cross(corner.c));
  const double along_b = corner.normal.dot(tangential.cross(corner.c)) / twice_area;
  const double along_c = corner.normal.dot(corner.b.cross(tangential)) / twice_area;
  return along_b * corner.ub + along_c * corner.uc;
}

}  // namespace

Points2 in_frame(const TriangleMesh& mesh, const Points2& uv) {
  const Eigen::Index origin = origin_of(mesh);
  const std::vector<Corner> corners = corners_at(mesh, uv, origin);
  Vec3 normal = Vec3::Zero();
  for (const Corner& corner : corners) normal += corner.angle * corner.normal;
  if (normal.norm() == 0.0) normal = corners.front().normal;
  const Vec3 axis = first_axis(normal.normalized());
  Vec2 u = Vec2::Zero();
  for (const Corner& corner : corners) u += corner.angle * mapped(corner, axis);
  if (u.norm() == 0.0) u = Vec2::UnitX();
  u.normalize();
  Eigen::Matrix2d axes;
  axes << u, Vec2(-u.y(), u.x());
  return (uv.rowwise() - uv.row(origin)) * axes;
}

}  // namespace palpation
