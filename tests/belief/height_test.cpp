// Surfaces from contacts with shapes whose heights are known.
#include "palpation/belief/height.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "palpation/base/error.h"
#include "palpation/base/random.h"
#include "palpation/geometry/reconstruct.h"

namespace palpation {
namespace {

constexpr double kNoise_m = 5e-5;

/// Waves of 20 mm and 1.5 mm height: slopes up to .47.
double wave(double x, double y) {
  constexpr double k = 2.0 * std::numbers::pi / 0.020;
  return 1.5e-3 * std::sin(k * x) * std::cos(k * y);
}

/// A square lattice over 30 x 30 mm, jittered by a quarter of its step of 1 mm, with noise; where
/// `keep` says so.
Points contacts(const std::function<bool(double, double)>& keep, double noise_m = kNoise_m) {
  Random random(7);
  std::vector<Vec3> points;
  for (int i = 0; i <= 30; ++i) {
    for (int j = 0; j <= 30; ++j) {
      const double x = 1e-3 * (i + 0.5 * random.uniform() - 0.25),
                   y = 1e-3 * (j + 0.5 * random.uniform() - 0.25),
                   z = wave(x, y) + noise_m * random.normal();
      if (keep(x, y)) points.emplace_back(x, y, z);
    }
  }
  Points rows(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = points[i];
  return rows;
}

bool everywhere(double, double) { return true; }

Points all_up(const Points& points, const Vec3& up = Vec3::UnitZ()) {
  return up.transpose().replicate(points.rows(), 1);
}

struct Fitted {
  Reconstruction rough;
  HeightFit fit;
  Surface surface;
};

Fitted fitted(const Points& points, const Points& outward, const ReconstructOptions& how = {}) {
  Reconstruction rough = reconstruct(points, outward, how);
  HeightFit fit = fit_height(Surface(rough.mesh), points,
                             {.spacing_m = rough.spacing_m, .reach_m = rough.spacing_m});
  Surface surface(fit.mesh);
  return {std::move(rough), std::move(fit), std::move(surface)};
}

Fitted fitted(const Points& points) { return fitted(points, all_up(points)); }

struct Errors {
  double rms_m = 0.0, within = 0.0;
};

/// Of the vertices against the true heights, along the normal; and which part lies within 1.96
/// height_sd.
Errors errors_of(const Fitted& made, const std::function<double(const Vec3&)>& distance) {
  Errors errors;
  const int count = made.surface.vertex_count();
  for (int vertex = 0; vertex < count; ++vertex) {
    const double error = distance(made.surface.vertex(vertex));
    errors.rms_m += error * error / count;
    errors.within += (std::abs(error) <= 1.96 * made.fit.height_sd[vertex]) * 1.0 / count;
  }
  errors.rms_m = std::sqrt(errors.rms_m);
  return errors;
}

/// First order in the slope's square: 5 % of the error at most.
double off_wave(const Vec3& p) {
  constexpr double k = 2.0 * std::numbers::pi / 0.020;
  const double along_x = 1.5e-3 * k * std::cos(k * p.x()) * std::cos(k * p.y()),
               along_y = -1.5e-3 * k * std::sin(k * p.x()) * std::sin(k * p.y());
  return (p.z() - wave(p.x(), p.y())) / std::sqrt(1.0 + along_x * along_x + along_y * along_y);
}

// 961 contacts with noise of .05 mm, about ten of them within a quarter of a wave: the surface is
// surer than a contact, and knows how much.
TEST(FitHeight, FindsWavesBelowTheNoiseOfAContactAndSaysHowSureItIs) {
  const Fitted made = fitted(contacts(everywhere));
  const Errors errors = errors_of(made, off_wave);
  EXPECT_LT(errors.rms_m, 0.8 * kNoise_m);
  EXPECT_GT(errors.within, 0.85);
  EXPECT_NEAR(made.fit.contact_sd, kNoise_m, 0.3 * kNoise_m);
  EXPECT_NEAR(made.rough.spacing_m, 1e-3, 0.15e-3);
  EXPECT_TRUE(made.fit.outliers.empty());
  EXPECT_TRUE(made.surface.topology().is_disk());
}

TEST(FitHeight, EndsWhereContactsEndAndLeavesAHoleOpen) {
  // A disk of radius 5 mm is left out, and a quarter of the square: 900 - 25 pi - 225 mm2.
  const Fitted made = fitted(contacts([](double x, double y) {
    return std::hypot(x - 8e-3, y - 8e-3) > 5e-3 && !(x > 15e-3 && y > 15e-3);
  }));
  EXPECT_EQ(made.surface.topology().components, 1);
  EXPECT_EQ(made.surface.topology().borders, 2);
  for (int vertex = 0; vertex < made.surface.vertex_count(); ++vertex) {
    const Vec3 p = made.surface.vertex(vertex);
    EXPECT_GT(std::hypot(p.x() - 8e-3, p.y() - 8e-3), 4e-3);
    EXPECT_FALSE(p.x() > 17e-3 && p.y() > 17e-3) << p.transpose();  // a gap of 3 mm may be closed
  }
}

TEST(FitHeight, LeavesOutliersOutByNumber) {
  Points points = contacts(everywhere);
  points(100, 2) += 8e-3;
  points(500, 2) -= 1e-3;
  points(700, 2) += 20e-3;
  const Fitted made = fitted(points);
  std::vector<int> found = made.rough.outliers;
  found.insert(found.end(), made.fit.outliers.begin(), made.fit.outliers.end());
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  EXPECT_EQ(found, (std::vector<int>{100, 500, 700}));
  EXPECT_LT(errors_of(made, off_wave).rms_m, 0.8 * kNoise_m);
}

// A probe does not reach a layer behind another: which is the tissue, a person must say. What
// would be wrong is one surface between them.
TEST(FitHeight, KeepsTwoLayersApart) {
  const Points near = contacts(everywhere);
  Points both(2 * near.rows(), 3);
  both << near, near.rowwise() + Vec3(0.3e-3, 0.4e-3, 20e-3).transpose();
  const Fitted made = fitted(both, all_up(both));
  EXPECT_EQ(made.surface.topology().components, 2);
  for (int vertex = 0; vertex < made.surface.vertex_count(); ++vertex) {
    const double z = made.surface.vertex(vertex).z();
    EXPECT_GT(std::abs(z - 10e-3), 7.5e-3);  // 8.5 mm, less one distance of contacts
    EXPECT_GT(made.surface.vertex_normals()(vertex, 2), 0.5);
  }
}

// The same contacts turned in space: the surface turns with them.
TEST(FitHeight, DoesNotCareWhichWayIsUp) {
  const Points level = contacts(everywhere);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(2.2, Vec3(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
  const Points points = level * turn.transpose();
  const Fitted made = fitted(points, all_up(points, turn * Vec3::UnitZ()));
  const Errors errors =
      errors_of(made, [&](const Vec3& p) { return off_wave(turn.transpose() * p); });
  EXPECT_LT(errors.rms_m, 0.8 * kNoise_m);
  const Vec3 mean = made.surface.vertex_normals().colwise().mean();
  EXPECT_GT(mean.normalized().dot(turn * Vec3::UnitZ()), 0.95);
}

TEST(FitHeight, ScalesWithItsUnit) {
  const Points points = contacts(everywhere);
  const Fitted metres = fitted(points), larger = fitted(1024.0 * points);
  ASSERT_EQ(larger.surface.face_count(), metres.surface.face_count());
  // A power of two: only the search for hyperparameters rounds otherwise.
  EXPECT_NEAR(larger.fit.contact_sd / 1024.0, metres.fit.contact_sd, 0.02 * kNoise_m);
}

// Fibonacci's points on half a sphere of 20 mm, steep at its rim: no direction shows it all.
TEST(FitHeight, GoesRoundAHemisphere) {
  Random random(3);
  constexpr int kCount = 800;
  constexpr double kRadius_m = 0.020;
  Points points(kCount, 3);
  for (int i = 0; i < kCount; ++i) {
    const double z = (i + 0.5) / kCount, angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double across = std::sqrt(1.0 - z * z);
    points.row(i) = (kRadius_m + kNoise_m * random.normal()) *
                    Vec3(across * std::cos(angle), across * std::sin(angle), z).transpose();
  }
  const Fitted made = fitted(points);
  EXPECT_EQ(made.rough.by, Triangulation::AdvancingFront);
  EXPECT_TRUE(made.surface.topology().is_disk());
  const Errors errors = errors_of(made, [](const Vec3& p) { return p.norm() - kRadius_m; });
  EXPECT_LT(errors.rms_m, kNoise_m);
  // 2 pi r^2, less a rim of half a spacing and what is beyond the outermost points.
  EXPECT_NEAR(made.surface.area(), 2.0 * std::numbers::pi * kRadius_m * kRadius_m, 0.08 * 2.5e-3);
  for (int vertex = 0; vertex < made.surface.vertex_count(); ++vertex)
    EXPECT_GT(
        made.surface.vertex_normals().row(vertex).dot(made.surface.vertex(vertex).normalized()),
        0.9);
}

TEST(Reconstruct, RefusesWhatIsNoSurface) {
  Points line(40, 3);
  for (int i = 0; i < 40; ++i) line.row(i) << 1e-3 * i, 2e-3 * i, 0.0;
  EXPECT_THROW(reconstruct(line, all_up(line)), InvalidInput);
  const Points few = contacts(everywhere).topRows(11);
  EXPECT_THROW(reconstruct(few, all_up(few)), InvalidInput);
  EXPECT_THROW(reconstruct(few, all_up(few).topRows(3)), InvalidInput);
}

}  // namespace
}  // namespace palpation
