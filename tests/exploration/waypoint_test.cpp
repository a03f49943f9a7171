#include "palpation/exploration/waypoint.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "belief/tissue.h"
#include "palpation/base/error.h"
#include "palpation/geometry/make_phantom.h"
#include "palpation/geometry/path.h"

namespace palpation {
namespace {

TEST(Waypoints, StandOffAndPressAlongTheNormal) {
  const Surface tissue = plane(26, 51);
  const std::vector<SurfacePoint> targets{tissue.at_vertex(0), tissue.at_vertex(100)};
  const std::vector<Waypoint> poses =
      waypoints(tissue, targets, {.standoff_m = 0.005, .indent_m = 0.002});
  ASSERT_EQ(poses.size(), 2u);
  for (const Waypoint& pose : poses) {
    EXPECT_NEAR((pose.normal - Vec3::UnitZ()).norm(), 0.0, 1e-15);
    EXPECT_NEAR((pose.approach - pose.position - Vec3(0, 0, 0.005)).norm(), 0.0, 1e-15);
    EXPECT_NEAR((pose.position - pose.indented - Vec3(0, 0, 0.002)).norm(), 0.0, 1e-15);
    EXPECT_NEAR((pose.rotation.col(2) + Vec3::UnitZ()).norm(), 0.0,
                1e-15);  // its z into the tissue
    EXPECT_NEAR(pose.rotation.determinant(), 1.0, 1e-14);
    EXPECT_NEAR(pose.expected_force_n, 0.16, 1e-15);  // 0.08 N/mm x 2 mm
  }
}

TEST(Waypoints, AreInTheRobotsFrame) {
  const Surface tissue = plane(26, 51);
  Robot robot;
  robot.from_tissue.topLeftCorner<3, 3>() =
      Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  robot.from_tissue.topRightCorner<3, 1>() = Vec3(0.1, -0.2, 0.3);
  const std::vector<SurfacePoint> targets{tissue.at_vertex(77)};
  const Waypoint pose = waypoints(tissue, targets, robot).front();
  const Vec3 expected =
      robot.from_tissue.topLeftCorner<3, 3>() * tissue.vertex(77) + Vec3(0.1, -0.2, 0.3);
  EXPECT_NEAR((pose.position - expected).norm(), 0.0, 1e-15);
  EXPECT_NEAR((pose.rotation.col(2) + pose.normal).norm(), 0.0, 1e-15);
  const Eigen::Vector4d q = quaternion(pose.rotation);
  EXPECT_NEAR(
      (Eigen::Quaterniond(q[3], q[0], q[1], q[2]).toRotationMatrix() - pose.rotation).norm(), 0.0,
      1e-14);
}

TEST(Waypoints, TurnByTheLeastRotation) {
  // Two flat halves that meet at 90 degrees along the y axis.
  TriangleMesh roof;
  roof.vertices.resize(6, 3);
  roof.vertices << 0, 0, 0, 0, 1, 0, -1, 0, -1, -1, 1, -1, 1, 0, -1, 1, 1, -1;
  roof.vertices *= 0.01;
  roof.triangles.resize(4, 3);
  roof.triangles << 2, 0, 1, 2, 1, 3, 0, 4, 5, 0, 5, 1;
  const Surface surface(roof);
  const std::vector<SurfacePoint> targets{surface.at_vertex(2), surface.at_vertex(5)};
  const std::vector<Waypoint> poses = waypoints(surface, targets, {});
  const Eigen::AngleAxisd turn(poses[1].rotation * poses[0].rotation.transpose());
  const double least = std::acos(poses[0].rotation.col(2).dot(poses[1].rotation.col(2)));
  EXPECT_NEAR(turn.angle(), least, 1e-9);
}

/// A rotation that turns one direction to another about the axis across both, by their angle
/// (Rodrigues' formula).
Eigen::Matrix3d least_rotation(const Vec3& from, const Vec3& to) {
  const Vec3 axis = from.cross(to);
  const double cosine = from.dot(to);
  Eigen::Matrix3d cross;
  cross << 0.0, -axis.z(), axis.y(), axis.z(), 0.0, -axis.x(), -axis.y(), axis.x(), 0.0;
  return Eigen::Matrix3d::Identity() + cross + cross * cross / (1.0 + cosine);
}

TEST(Waypoints, FollowCurvedTissueFromOutsideEachPoseTheOneBeforeUnderTheLeastRotation) {
  struct Curved {
    Sheet sheet;
    double tightest_m;  // radius of its sharpest bend
  };
  for (const auto& [sheet, tightest_m] :
       {Curved{cylinder_sheet(), 0.015}, Curved{dome_sheet(), 0.025}, Curved{saddle_sheet(), 0.025},
        Curved{wave_sheet(), 0.005}, Curved{folded_sheet(), 0.00075}}) {
    Random random(1);
    const PhantomMesh phantom = make_phantom(sheet, 0.00025, 0.3, random);
    const Surface tissue(phantom.mesh);
    const int first = 1234, last = tissue.vertex_count() - 2345;
    const std::vector<SurfacePoint> way =
        way_between(tissue, tissue.at_vertex(first), tissue.at_vertex(last), 0.00025);
    ASSERT_GT(way.size(), 40u);
    const std::vector<Waypoint> poses = waypoints(tissue, way, {});
    for (std::size_t k = 0; k < poses.size(); ++k) {
      Vec2 parameters = Vec2::Zero();
      for (int i = 0; i < 3; ++i)
        parameters += way[k].barycentric[i] *
                      phantom.parameters.row(tissue.triangle(way[k].face)[i]).transpose();
      const Vec3 truth = sheet.normal(parameters);
      EXPECT_LT(std::atan2(poses[k].normal.cross(truth).norm(), poses[k].normal.dot(truth)),
                1.0 * 3.1415926 / 180.0);
      EXPECT_GT((poses[k].approach - poses[k].position).dot(truth), 0.0049);
      EXPECT_LT((poses[k].indented - poses[k].position).dot(truth), -0.0019);
      if (k == 0) continue;
      const Eigen::Matrix3d turn =
          least_rotation(poses[k - 1].rotation.col(2), poses[k].rotation.col(2));
      EXPECT_LT((poses[k].rotation - turn * poses[k - 1].rotation).cwiseAbs().maxCoeff(), 1e-9);
      // 0.25 mm of tissue, and what the mesh adds.
      EXPECT_LT(std::acos(std::min(1.0, poses[k].normal.dot(poses[k - 1].normal))),
                0.00025 / tightest_m + 0.02);
    }
  }
}

/// Vertices and triangles of a plain OBJ in centimetres, and nothing else of it.
TriangleMesh organ_in(std::istream& file) {
  std::vector<Vec3> vertices;
  std::vector<Eigen::Vector3i> triangles;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Vec3& place = vertices.emplace_back();
      words >> place.x() >> place.y() >> place.z();
    } else if (kind == "f") {
      Eigen::Vector3i& corners = triangles.emplace_back();
      for (int& corner : corners) {
        std::string word;
        words >> word;
        corner = std::stoi(word) - 1;
      }
    }
  }
  TriangleMesh mesh;
  mesh.vertices.resize(static_cast<Eigen::Index>(vertices.size()), 3);
  mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t v = 0; v < vertices.size(); ++v)
    mesh.vertices.row(static_cast<Eigen::Index>(v)) = 0.01 * vertices[v];
  for (std::size_t f = 0; f < triangles.size(); ++f)
    mesh.triangles.row(static_cast<Eigen::Index>(f)) = triangles[f];
  return mesh;
}

/// How often a closed surface goes around a place: 1 inside, 0 outside. The solid angles of its
/// triangles (van Oosterom and Strackee 1983).
double winding(const Surface& closed, const Vec3& place) {
  double sum = 0.0;
  for (int face = 0; face < closed.face_count(); ++face) {
    const Eigen::Vector3i t = closed.triangle(face);
    const Vec3 a = closed.vertex(t[0]) - place, b = closed.vertex(t[1]) - place,
               c = closed.vertex(t[2]) - place;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2.0 * std::atan2(a.dot(b.cross(c)),
                            la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4.0 * 3.14159265358979);
}

TEST(Waypoints, ComeToARealOrganFromOutsideEachPoseTheOneBeforeUnderTheLeastRotation) {
  std::ifstream file(PALPATION_SOURCE_DIR "/../shared/data/meshes/liver-smooth.obj");
  if (!file)
    GTEST_SKIP() << "needs liver-smooth.obj, a mesh that is no part of the project, in "
                    "../shared/data/meshes";
  const Surface liver(organ_in(file));
  ASSERT_TRUE(liver.topology().is_closed());
  const std::vector<SurfacePoint> way =
      way_between(liver, liver.at_vertex(100), liver.at_vertex(1900), 0.001);
  ASSERT_GT(way.size(), 20u);
  const std::vector<Waypoint> poses =
      waypoints(liver, way, {.standoff_m = 0.0005, .indent_m = 0.0005});
  for (std::size_t k = 0; k < poses.size(); ++k) {
    EXPECT_NEAR(winding(liver, poses[k].approach), 0.0, 1e-6) << k;
    EXPECT_NEAR(winding(liver, poses[k].indented), 1.0, 1e-6) << k;
    EXPECT_GT(poses[k].normal.dot(liver.face_normal(way[k].face)), 0.9) << k;
    if (k == 0) continue;
    const Eigen::Matrix3d turn =
        least_rotation(poses[k - 1].rotation.col(2), poses[k].rotation.col(2));
    EXPECT_LT((poses[k].rotation - turn * poses[k - 1].rotation).cwiseAbs().maxCoeff(), 1e-9) << k;
  }
}

TEST(Robot, RefusesATransformThatIsNotRigid) {
  Robot robot;
  robot.from_tissue(0, 0) = 1.1;
  EXPECT_THROW(check(robot), InvalidInput);
  robot.from_tissue(0, 0) = -1.0;  // mirrored
  EXPECT_THROW(check(robot), InvalidInput);
}

}  // namespace
}  // namespace palpation
