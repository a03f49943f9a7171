#include "palpation/robot/registration.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "palpation/base/error.h"
#include "palpation/base/random.h"
#include "palpation/geometry/make_phantom.h"
#include "palpation/geometry/make_plane.h"

namespace palpation {
namespace {

Eigen::Isometry3d somewhere() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(Vec3(0.1, -0.05, 0.2));
  pose.rotate(Eigen::AngleAxisd(0.8, Vec3(1.0, 2.0, -1.0).normalized()));
  return pose;
}

std::vector<TouchedPair> pairs_of(const std::vector<Vec3>& places, const Eigen::Isometry3d& pose) {
  std::vector<TouchedPair> pairs;
  for (const Vec3& place : places) pairs.push_back({place, pose * place});
  return pairs;
}

std::string refusal(const std::vector<TouchedPair>& pairs) {
  try {
    register_pairs(pairs);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

const std::vector<Vec3> kCorners = {Vec3(0, 0, 0), Vec3(0.02, 0, 0), Vec3(0, 0.03, 0)};

/// It holds in place: no two directions bend alike.
Surface saddle() {
  Random random(1);
  return Surface(make_phantom(saddle_sheet(), 0.001, 0.2, random).mesh);
}

TEST(RegisterPairs, FindsTheTransformOfThreeCornersToRounding) {
  const Registration found = register_pairs(pairs_of(kCorners, somewhere()));
  EXPECT_NEAR((found.from_tissue - somewhere().matrix()).cwiseAbs().maxCoeff(), 0.0, 1e-14);
  EXPECT_LT(found.rms_m, 1e-14);
  const Eigen::Matrix3d turn = found.from_tissue.topLeftCorner(3, 3);
  EXPECT_NEAR(turn.determinant(), 1.0, 1e-14);
}

TEST(RegisterPairs, RefusesPlacesOnALineTooFewOtherUnitsAndMirrors) {
  EXPECT_NE(refusal(pairs_of({kCorners[0], kCorners[1]}, somewhere())).find("three at least"),
            std::string::npos);
  const std::vector<Vec3> line = {Vec3(0, 0, 0), Vec3(0.01, 0.0001, 0), Vec3(0.02, 0, 0)};
  EXPECT_NE(refusal(pairs_of(line, somewhere())).find("beside one line"), std::string::npos);
  std::vector<TouchedPair> pairs = pairs_of(kCorners, somewhere());
  for (TouchedPair& pair : pairs) pair.tissue *= 1000.0;
  EXPECT_NE(refusal(pairs).find("in millimetres?"), std::string::npos);
  pairs =
      pairs_of({Vec3(0, 0, 0), Vec3(0.02, 0, 0), Vec3(0, 0.03, 0), Vec3(0, 0, 0.01)}, somewhere());
  for (TouchedPair& pair : pairs) pair.robot.x() = -pair.robot.x();
  EXPECT_NE(refusal(pairs).find("mirror"), std::string::npos);
  pairs[0].robot.y() = std::nan("");
  EXPECT_NE(refusal(pairs).find("pair 0 must be finite"), std::string::npos);
}

TEST(RegisterPairs, ItsCovarianceIsThatOfManyTrials) {
  Random random(4);
  const std::vector<Vec3> places = {Vec3(0, 0, 0), Vec3(0.02, 0, 0.002), Vec3(0, 0.03, 0),
                                    Vec3(0.02, 0.03, 0.004), Vec3(0.01, 0.015, 0.01)};
  constexpr double kSd_m = 0.0005;
  constexpr int kTrials = 4000;
  Covariance6 seen = Covariance6::Zero(), told = Covariance6::Zero();
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<TouchedPair> pairs = pairs_of(places, somewhere());
    for (TouchedPair& pair : pairs)
      pair.robot += kSd_m * Vec3(random.normal(), random.normal(), random.normal());
    const Registration found = register_pairs(pairs, 1e-6);
    const Eigen::Isometry3d off = Eigen::Isometry3d(found.from_tissue) * somewhere().inverse();
    const Eigen::AngleAxisd turn(off.linear());
    Eigen::Matrix<double, 6, 1> error;
    error << turn.angle() * turn.axis(), off * found.centre - found.centre;
    seen += error * error.transpose() / kTrials;
    told += found.covariance / kTrials;
  }
  // The scatter of a variance over 4000 trials is 2.2 %: five of these.
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(seen(i, i) / told(i, i), 1.0, 0.12) << i;
}

TEST(RefineOnSurface, FindsTissueThatCurvesFromAMillimetreAndTwoDegreesOff) {
  const Surface tissue = saddle();
  Random random(6);
  std::vector<Vec3> touched;
  for (int i = 0; i < 40; ++i)
    touched.push_back(somewhere() * tissue.vertex(random.below(tissue.vertex_count())));
  Registration guess;
  Eigen::Isometry3d off = somewhere();
  off.translate(Vec3(0.0005, -0.0005, 0.0007));
  off.rotate(Eigen::AngleAxisd(0.035, Vec3(0.3, 1.0, 0.5).normalized()));
  guess.from_tissue = off.matrix();
  const Registration found = refine_on_surface(tissue, touched, guess);
  EXPECT_LT(found.rms_m, 1e-8);
  for (int i = 0; i < tissue.vertex_count(); i += 17) {
    const Vec3 is = Eigen::Isometry3d(found.from_tissue) * tissue.vertex(i);
    EXPECT_LT((is - somewhere() * tissue.vertex(i)).norm(), 1e-6) << i;
  }
  EXPECT_GT(uncertainty_along_normal_m(tissue, found), 0.0);
  EXPECT_LT(uncertainty_along_normal_m(tissue, found), 0.001);
}

TEST(Uncertainty, AlongTheSurfaceAndAcrossItIsThatOfItsNormal) {
  Random random(7);
  const Surface plane(make_plane({.size_m = Vec2(0.02, 0.03), .columns = 9, .rows = 9}, random));
  Registration found;  // sure but of a shift: 1 mm along x, 2 mm along y, 0.1 mm along z
  found.covariance.diagonal().tail<3>() = Vec3(1e-6, 4e-6, 1e-8);
  EXPECT_NEAR(uncertainty_along_surface_m(plane, found), 1.959964 * 0.002, 1e-9);
  EXPECT_NEAR(uncertainty_along_normal_m(plane, found), 1.959964 * 0.0001, 1e-9);
}

TEST(RefineOnSurface, RefusesAPlaneWhichCanSlideAndPlacesFarOff) {
  Random random(7);
  const Surface plane(make_plane({.size_m = Vec2(0.02, 0.03), .columns = 9, .rows = 9}, random));
  std::vector<Vec3> touched;
  for (int i = 0; i < plane.vertex_count(); i += 5) touched.push_back(plane.vertex(i));
  EXPECT_THROW(refine_on_surface(plane, touched, Registration{}), InvalidInput);
  const Surface tissue = saddle();
  touched.clear();
  for (int i = 0; i < 8; ++i) touched.push_back(tissue.vertex(7 * i) + Vec3(0, 0, 0.5));
  EXPECT_THROW(refine_on_surface(tissue, touched, Registration{}), InvalidInput);
  EXPECT_THROW(refine_on_surface(tissue, std::span(touched).first(5), Registration{}),
               InvalidInput);
}

}  // namespace
}  // namespace palpation
