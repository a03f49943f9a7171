// Noise from none to all there is, and places from one and the same to far apart, against closed
// forms and eighty digits.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "belief/oracle.h"
#include "belief/tissue.h"

namespace palpation {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kUnknown = std::numeric_limits<double>::infinity();
constexpr double kLength_m = 0.0033;

/// One metre by one: two triangles, every place inside a face.
Surface square_metre() {
  Random unused(0);
  return Surface(make_plane({.size_m = Vec2(1.0, 1.0), .columns = 2, .rows = 2}, unused));
}

Palpation touch_at(const SurfacePoint& where, double reading, double noise_variance) {
  Palpation palpation;
  palpation.where = where;
  palpation.reading = reading;
  palpation.noise_variance = noise_variance;
  return palpation;
}

/// Readings of unit size on a jittered lattice a length apart, all of one noise variance.
std::vector<Palpation> lattice_readings(const Surface& tissue, int side, double spacing_m,
                                        double noise_variance, Random& random) {
  std::vector<Palpation> palpations;
  for (int i = 0; i < side * side; ++i) {
    const Vec3 place(0.3 + spacing_m * (i % side + 0.3 * random.uniform()),
                     0.4 + spacing_m * (i / side + 0.3 * random.uniform()), 0.0);
    palpations.push_back(touch_at(tissue.project(place), random.normal(), noise_variance));
  }
  return palpations;
}

Belief belief_from(const Prior& prior, const std::vector<Palpation>& palpations) {
  return Belief(prior, {.noise_sd = 1.0}).condition_on(palpations);
}

TEST(NoiseExtremes, OneReadingIsItsClosedFormFromNoNoiseToNothingButNoise) {
  const Surface tissue = square_metre();
  const SurfacePoint where = tissue.project(Vec3(0.41, 0.37, 0.0));
  const Prior prior(tissue, Metric::Chart, {}, {.sd = 0.0});
  for (int exponent = -300; exponent <= 300; exponent += 4) {
    const double s2 = std::pow(10.0, exponent);
    const Marginals at = belief_from(prior, {touch_at(where, 3.0, s2)}).at(std::span(&where, 1));
    EXPECT_NEAR(at.variance[0] / (s2 < 1.0 ? s2 / (1.0 + s2) : 1.0 / (1.0 + 1.0 / s2)), 1.0,
                4.0 * kEps)
        << s2;
    EXPECT_NEAR(at.mean[0] / (3.0 / (1.0 + s2)), 1.0, 4.0 * kEps) << s2;
  }
}

TEST(NoiseExtremes, ReadingsOfNothingButNoiseLeaveThePrior) {
  const Surface tissue = plane(20, 40);
  for (const double s2 : {1e8, 1e20, 1e300}) {
    std::vector<Palpation> readings;
    Random random(1);
    for (Palpation& palpation : readings = bumpy_readings(tissue, 20, random))
      palpation.noise_variance = s2;
    const Prior prior(tissue, Metric::Chart, {}, {.sd = 0.0});
    const Marginals at = belief_from(prior, readings).at_vertices();
    const BigPosterior exact(prior, readings, s2);
    for (int vertex = 0; vertex < tissue.vertex_count(); ++vertex) {
      const BigPosterior::At right = exact.at(prior.coordinates(vertex));
      EXPECT_LT(absolute_error(at.variance[vertex], right.variance), 4.0 * kEps) << s2;
      // Twenty readings of about 8, each with weight 1 / s2.
      EXPECT_LT(absolute_error(at.mean[vertex], right.mean), 4.0 * kEps * 200.0 / s2) << s2;
      EXPECT_EQ(at.variance[vertex], s2 > 1e18 ? 1.0 : at.variance[vertex]);
    }
  }
}

TEST(NoiseExtremes, VarianceKeepsElevenDigitsAtATouchedPlaceWhateverTheNoise) {
  const Surface tissue = square_metre();
  for (const double s2 : {1e-2, 1e-4, 1e-6, 1e-10, 1e-12, 1e-14, 1e-15, 1e-20, 1e-30}) {
    Random random(2);
    const Prior prior(tissue, Metric::Chart, {.length_m = kLength_m}, {.sd = 0.0});
    const std::vector<Palpation> readings = lattice_readings(tissue, 5, kLength_m, s2, random);
    const Belief belief = belief_from(prior, readings);
    const BigPosterior exact(prior, readings, s2);
    for (const Palpation& palpation : readings) {
      const double ours = belief.at(std::span(&palpation.where, 1)).variance[0];
      EXPECT_LT(relative_error(ours, exact.at(prior.coordinates(palpation.where)).variance), 1e-11)
          << s2;
    }
  }
}

TEST(NoiseExtremes, VarianceKeepsTwelveDigitsBesideATouchedPlaceAtEveryDistance) {
  const Surface tissue = square_metre();
  for (const KernelFamily family :
       {KernelFamily::SquaredExponential, KernelFamily::Matern12, KernelFamily::Matern32,
        KernelFamily::Matern52, KernelFamily::Periodic}) {
    for (const double s2 : {1e-6, 1e-12, 1e-15}) {
      Random random(3);
      const Prior prior(tissue, Metric::Chart,
                        {.family = family, .length_m = kLength_m, .period_m = 0.03}, {.sd = 0.0});
      const std::vector<Palpation> readings =
          lattice_readings(tissue, 4, 1.5 * kLength_m, s2, random);
      const Belief belief = belief_from(prior, readings);
      const BigPosterior exact(prior, readings, s2);
      const Vec3 site = prior.coordinates(readings[5].where);
      for (double distance = 1e-9; distance < 0.2; distance *= 10.0) {
        const SurfacePoint place =
            tissue.project(site + Vec3(0.8, 0.6, 0.0) * distance * kLength_m);
        const double ours = belief.at(std::span(&place, 1)).variance[0];
        EXPECT_LT(relative_error(ours, exact.at(prior.coordinates(place)).variance), 1e-12)
            << "noise " << s2 << ", " << distance << " lengths away, kernel "
            << static_cast<int>(family);
      }
    }
  }
}

TEST(NoiseExtremes, VarianceKeepsItsDigitsAtVerticesBesideATouchedOne) {
  const Surface tissue = plane(60, 120, 0.2);  // vertices an eighth of a length apart
  for (const double s2 : {1e-6, 1e-12}) {
    Random random(4);
    const Prior prior(tissue, Metric::Chart, {.length_m = kLength_m}, {.sd = 0.0});
    std::vector<Palpation> readings = bumpy_readings(tissue, 25, random);
    for (Palpation& palpation : readings) palpation.noise_variance = s2;
    const Field ours = belief_from(prior, readings).at_vertices().variance;
    const BigPosterior exact(prior, readings, s2);
    int small = 0;
    for (int vertex = 0; vertex < tissue.vertex_count(); ++vertex) {
      if (ours[vertex] > 1e-2) continue;
      const Big right = exact.at(prior.coordinates(vertex)).variance;
      const bool is_small = ours[vertex] < 1e-6;
      if (is_small) ++small;
      EXPECT_LT(relative_error(ours[vertex], right), is_small ? 1e-10 : 1e-8) << s2;
      EXPECT_LT(absolute_error(ours[vertex], right), 1e-14) << s2;
    }
    EXPECT_GT(small, 10);
  }
}

// How ill posed twins are grows with 1 / s2: they disagree by more than the noise allows.
TEST(NoiseExtremes, TwinsAMillionthOfAMillionthApartCostNoMoreThanTheirConditionNumber) {
  const Surface tissue = square_metre();
  const SurfacePoint first = tissue.project(Vec3(0.41, 0.37, 0.0));
  SurfacePoint second = first;
  second.barycentric += Vec3(1e-12, -1e-12, 0.0) * kLength_m;
  const Prior prior(tissue, Metric::Chart, {.length_m = kLength_m}, {.sd = 0.0});
  ASSERT_NE(prior.coordinates(first), prior.coordinates(second));
  for (const double s2 : {1e-2, 1e-6, 1e-10, 1e-12, 1e-14, 1e-15}) {
    std::vector<Palpation> readings{touch_at(first, 1.0, s2), touch_at(second, 1.1, s2)};
    readings.push_back(touch_at(tissue.project(Vec3(0.4115, 0.37, 0.0)), 0.5, s2));
    const Belief belief = belief_from(prior, readings);
    const BigPosterior exact(prior, readings, s2);
    const double condition = 3.0 / s2, size = std::sqrt(1.0 + 1.21 + 0.25);
    for (const double x : {0.41, 0.4103, 0.4121}) {
      const SurfacePoint place = tissue.project(Vec3(x, 0.3701, 0.0));
      const BigPosterior::At right = exact.at(prior.coordinates(place));
      const Marginals ours = belief.at(std::span(&place, 1));
      EXPECT_LT(absolute_error(ours.mean[0], right.mean), 10.0 * kEps * condition * size) << s2;
      EXPECT_LT(absolute_error(ours.variance[0], right.variance), 5e-11) << s2;
    }
  }
}

TEST(NoiseExtremes, AnUnknownConstantLosesNoDigitsOfTheVarianceBesideASite) {
  const Surface tissue = square_metre();
  Random random(5);
  const Prior prior(tissue, Metric::Chart, {.length_m = kLength_m}, {.sd = kUnknown});
  const std::vector<Palpation> readings =
      lattice_readings(tissue, 4, 1.5 * kLength_m, 1e-12, random);
  const Belief belief = belief_from(prior, readings);
  const BigPosterior exact(prior, readings, 1e-12);
  for (const Palpation& palpation : readings) {
    EXPECT_LT(relative_error(belief.at(std::span(&palpation.where, 1)).variance[0],
                             exact.at(prior.coordinates(palpation.where)).variance),
              1e-10);
  }
}

}  // namespace
}  // namespace palpation
