#include "robot/gate_words.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace palpation {
namespace {

std::string with_unit(double value, const char* unit) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3g %s", value, unit);
  return text;
}

Eigen::Quaterniond rotation_of(const ArmPose& pose) {
  return Eigen::Quaterniond(Eigen::Vector4d(pose.quaternion.normalized()));
}

}  // namespace

std::string mm_text(double metres) { return with_unit(metres * 1e3, "mm"); }
std::string mm_per_s_text(double metres_per_s) { return with_unit(metres_per_s * 1e3, "mm/s"); }
std::string newton_text(double newtons) { return with_unit(newtons, "N"); }
std::string ms_text(double seconds) { return with_unit(seconds * 1e3, "ms"); }
std::string degrees_text(double radians) {
  return with_unit(radians * 180.0 / std::numbers::pi, "degrees");
}

std::string place_text(const Vec3& metres) {
  char text[128];
  std::snprintf(text, sizeof text, "(%.4g, %.4g, %.4g) mm", metres.x() * 1e3, metres.y() * 1e3,
                metres.z() * 1e3);
  return text;
}

Vec3 axis_of(const ArmPose& pose) { return rotation_of(pose) * Vec3::UnitZ(); }

double turn_between(const ArmPose& a, const ArmPose& b) {
  return rotation_of(a).angularDistance(rotation_of(b));
}

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace palpation
