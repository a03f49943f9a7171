#include "palpation/exploration/waypoint.h"

#include <Eigen/Geometry>
#include <cmath>

#include "palpation/base/error.h"

namespace palpation {
namespace {

/// The rotation with z along `direction` whose x is nearest to the robot's x (its y where that is
/// along the direction).
Eigen::Matrix3d upright(const Vec3& direction) {
  const Vec3 reference = std::abs(direction.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY();
  Eigen::Matrix3d rotation;
  rotation.col(2) = direction;
  rotation.col(0) = (reference - reference.dot(direction) * direction).normalized();
  rotation.col(1) = direction.cross(rotation.col(0));
  return rotation;
}

Eigen::Matrix3d turned_to(const Eigen::Matrix3d& rotation, const Vec3& direction) {
  const Eigen::Matrix3d turned =
      Eigen::Quaterniond::FromTwoVectors(rotation.col(2), direction).toRotationMatrix() * rotation;
  // Small rounding must not add up over hundreds of stops.
  Eigen::Matrix3d clean;
  clean.col(2) = direction;
  clean.col(0) = (turned.col(0) - turned.col(0).dot(direction) * direction).normalized();
  clean.col(1) = direction.cross(clean.col(0));
  return clean;
}

void check_length(const char* name, double value) {
  require(std::isfinite(value) && value >= 0.0, "Robot", std::string(name) + " = " + text_of(value),
          "must be finite and not negative");
}

}  // namespace

void check(const Robot& robot) {
  const Eigen::Matrix3d rotation = robot.from_tissue.topLeftCorner<3, 3>();
  const bool rigid =
      robot.from_tissue.allFinite() &&
      (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <
          1e-6 &&
      rotation.determinant() > 0.0 &&
      robot.from_tissue.row(3) == Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0);
  require(
      rigid, "Robot", "from_tissue",
      "must be a rotation and a translation: orthonormal to 1e-6, not mirrored, last row 0 0 0 1");
  check_length("standoff_m", robot.standoff_m);
  check_length("indent_m", robot.indent_m);
  check_length("spring_n_per_m", robot.spring_n_per_m);
}

Eigen::Vector4d quaternion(const Eigen::Matrix3d& rotation) {
  Eigen::Vector4d coefficients = Eigen::Quaterniond(rotation).normalized().coeffs();
  return coefficients.w() < 0.0 ? Eigen::Vector4d(-coefficients) : coefficients;
}

std::vector<Waypoint> waypoints(const Surface& surface, std::span<const SurfacePoint> targets,
                                const Robot& robot, const Eigen::Matrix3d* before) {
  check(robot);
  const Eigen::Matrix3d rotation = robot.from_tissue.topLeftCorner<3, 3>();
  const Vec3 translation = robot.from_tissue.topRightCorner<3, 1>();
  std::vector<Waypoint> result;
  for (const SurfacePoint& target : targets) {
    Waypoint waypoint;
    waypoint.target = target;
    waypoint.position = rotation * surface.position(target) + translation;
    waypoint.normal = (rotation * surface.normal(target)).normalized();
    waypoint.approach = waypoint.position + robot.standoff_m * waypoint.normal;
    waypoint.indented = waypoint.position - robot.indent_m * waypoint.normal;
    const Eigen::Matrix3d* previous = result.empty() ? before : &result.back().rotation;
    waypoint.rotation =
        previous != nullptr ? turned_to(*previous, -waypoint.normal) : upright(-waypoint.normal);
    waypoint.expected_force_n = robot.spring_n_per_m * robot.indent_m;
    result.push_back(waypoint);
  }
  return result;
}

}  // namespace palpation
