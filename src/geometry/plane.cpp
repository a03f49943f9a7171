#include "geometry/plane.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace palpation {
namespace {

constexpr double kFlatness =
    1e-6;  // of the diameter: what single precision, as in STL, keeps of a tilted plane

Eigen::Index nearest_row(const Points& points, const Vec3& place) {
  Eigen::Index nearest = 0;
  (points.rowwise() - place.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
  return nearest;
}

bool lies_level(const TriangleMesh& mesh, const Plane& plane, double diameter) {
  const auto z = mesh.vertices.col(2);
  return plane.normal.z() > 0.0 && z.maxCoeff() - z.minCoeff() <= kFlatness * diameter;
}

}  // namespace

Vec3 area_vector(const TriangleMesh& mesh, Eigen::Index face) {
  const Vec3 a = mesh.vertices.row(mesh.triangles(face, 0)),
             b = mesh.vertices.row(mesh.triangles(face, 1)),
             c = mesh.vertices.row(mesh.triangles(face, 2));
  return 0.5 * (b - a).cross(c - a);
}

Vec3 centroid(const TriangleMesh& mesh) {
  const Vec3 origin = mesh.vertices.row(0);
  Vec3 moment = Vec3::Zero();
  double weight = 0.0;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const double area = area_vector(mesh, f).norm();
    Vec3 corners = Vec3::Zero();
    for (int i = 0; i < 3; ++i)
      corners += mesh.vertices.row(mesh.triangles(f, i)).transpose() - origin;
    moment += area * (corners / 3.0);
    weight += area;
  }
  return origin + moment / weight;
}

Vec3 first_axis(const Vec3& normal) {
  const double steep = std::cos(10.0 * std::numbers::pi / 180.0);
  const Vec3 along = std::abs(normal.x()) > steep ? Vec3::UnitY() : Vec3::UnitX();
  return (along - along.dot(normal) * normal).normalized();
}

Plane find_plane(const TriangleMesh& mesh, double diameter) {
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) sum += area_vector(mesh, f);
  if (sum.norm() == 0.0) return {};
  const Vec3 normal = sum.normalized();
  // Heights above the first vertex, not above the origin, which may be far away.
  const Eigen::VectorXd height = (mesh.vertices.rowwise() - mesh.vertices.row(0)) * normal;
  if (height.maxCoeff() - height.minCoeff() > kFlatness * diameter) return {};
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    if (area_vector(mesh, f).dot(normal) <= 0.0) return {.folded_face = f};
  }
  return {.is_plane = true, .normal = normal};
}

Chart lay_flat(const TriangleMesh& mesh, const Plane& plane, double diameter) {
  if (lies_level(mesh, plane, diameter)) return {mesh.vertices.leftCols<2>(), true};
  const Eigen::Index origin = nearest_row(mesh.vertices, centroid(mesh));
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = first_axis(plane.normal);
  axes.col(1) = plane.normal.cross(axes.col(0));
  return {(mesh.vertices.rowwise() - mesh.vertices.row(origin)) * axes, true};
}

}  // namespace palpation
