#include "palpation/world/lump.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "palpation/base/error.h"
#include "palpation/world/phantom.h"
#include "world/tissue.h"

namespace palpation {
namespace {

const Vec3 kMiddle(0.012, 0.024, 0.0);

Surface tissue() { return sheet(0.024, 0.048, 0.001); }

double felt(const Phantom& phantom, const Surface& surface, const Vec3& where) {
  Random random(1);
  return phantom.touch(surface.at_vertex(surface.nearest_vertex(where)), random).reading;
}

// Half of the height lies at the depth 0 of a disk, whatever the profile but the dome, whose top is
// above its rim by what it is domed.
TEST(Profile, HasHalfOfItsHeightOnTheOutline) {
  for (const Profile profile : {Profile::Sigmoid, Profile::Cone, Profile::Gauss, Profile::Hill})
    EXPECT_NEAR(profile_share(profile, 0.0, 0.006, 1400.0, 0.0), 0.5, 1e-15);
  EXPECT_NEAR(profile_share(Profile::Dome, 0.0, 0.006, 1400.0, 0.0), 0.5 * 0.7, 1e-15);
}

TEST(Profile, ReachesItsHeightAtTheDeepestPlace) {
  for (const Profile profile : {Profile::Cone, Profile::Gauss, Profile::Hill})
    EXPECT_EQ(profile_share(profile, 0.006, 0.006, 1400.0, 0.0), 1.0);
  EXPECT_NEAR(profile_share(Profile::Dome, 0.006, 0.006, 1400.0, 0.0), 1.0 / (1.0 + std::exp(-8.4)),
              1e-15);
}

// Far from it the share falls as the third power of the distance: at twice the half width it is
// (1 + 4 h)^(-3/2), h = 4^(1/3) - 1.
TEST(Profile, OfAHillFallsAsABuriedSphereIsFelt) {
  EXPECT_NEAR(profile_share(Profile::Hill, -0.006, 0.006, 1400.0, 0.0),
              std::pow(1.0 + 4.0 * (std::cbrt(4.0) - 1.0), -1.5), 1e-15);
}

// The paper's formula, with and without the design around it, to the bit.
TEST(PhantomDesign, OfPlainLumpsIsThePaperPhantom) {
  const Surface surface = tissue();
  const Disk disk{kMiddle, 0.006}, other{Vec3(0.012, 0.040, 0.0), 0.003};
  const StiffnessModel model{.noise = 0.05, .bias = 0.1};
  const Phantom paper(surface, {disk, other}, model);
  const Phantom designed(
      surface, PhantomDesign{.lumps = {{.outline = disk}, {.outline = other}}, .model = model});
  EXPECT_EQ(paper.truth(), designed.truth());
  Random one(3), two(3);
  for (int vertex = 0; vertex < surface.vertex_count(); vertex += 17) {
    EXPECT_EQ(paper.touch(surface.at_vertex(vertex), one).reading,
              designed.touch(surface.at_vertex(vertex), two).reading);
  }
}

// exp(-1400 * 0.006) = 0.0002 is missing to the plateau of 7 + 0.5 * 2.
TEST(PhantomDesign, FeelsAWeakLumpWeaklyAndCountsItAsTumour) {
  const Surface surface = tissue();
  const Phantom phantom(
      surface, PhantomDesign{.lumps = {{.outline = Disk{kMiddle, 0.006}, .contrast = 0.5}}});
  EXPECT_NEAR(felt(phantom, surface, kMiddle), 8.0, 3e-4);
  EXPECT_NEAR(phantom.truth()[surface.nearest_vertex(kMiddle)], 9.0, 6e-4);
  EXPECT_NEAR(phantom.truth()[surface.nearest_vertex(kMiddle + Vec3(0.006, 0.0, 0.0))],
              phantom.true_level(), 1e-9);
}

// Two sides, 3 mm within the outline: on the steep one slope 2,800 on the whole way out, on the
// other 700. Half way out the exponent is that of half a radius.
TEST(PhantomDesign, RisesFasterOnTheSteepSide) {
  const Surface surface = tissue();
  const Phantom phantom(surface, PhantomDesign{.lumps = {{.outline = Disk{kMiddle, 0.006},
                                                          .steeper = 2.0,
                                                          .steep_towards = Vec3::UnitX()}}});
  const auto share = [](double slope, double depth) {
    return 1.0 / (1.0 + std::exp(-slope * depth));
  };
  EXPECT_NEAR(felt(phantom, surface, kMiddle + Vec3(0.003, 0.0, 0.0)),
              7.0 + 2.0 * share(1400.0 * std::sqrt(2.0), 0.003), 1e-9);
  EXPECT_NEAR(felt(phantom, surface, kMiddle - Vec3(0.003, 0.0, 0.0)),
              7.0 + 2.0 * share(1400.0 / std::sqrt(2.0), 0.003), 1e-9);
}

TEST(BackgroundField, OfAVesselIsHighOnItsLineAndGoneFarFromIt) {
  const Surface surface = tissue();
  const Field field = background_field(
      surface,
      std::vector<Background>{Vessel{.height = 0.3,
                                     .half_width_m = 0.001,
                                     .line_m = {Vec3(0.0, 0.024, 0.0), Vec3(0.024, 0.024, 0.0)}}});
  EXPECT_EQ(field[surface.nearest_vertex(kMiddle)], 0.3);
  EXPECT_NEAR(field[surface.nearest_vertex(kMiddle + Vec3(0.0, 0.001, 0.0))], 0.3 * std::exp(-0.5),
              1e-12);
  EXPECT_LT(field[surface.nearest_vertex(kMiddle + Vec3(0.0, 0.010, 0.0))], 1e-20);
}

// From trough to crest: sines of a whole wave take both ends.
TEST(BackgroundField, OfAWaveSpansItsHeight) {
  const Surface surface = tissue();
  const Field field = background_field(
      surface,
      std::vector<Background>{Wave{.height = 0.3, .length_m = 0.024, .direction = Vec3::UnitY()}});
  EXPECT_NEAR(field.maxCoeff(), 0.15, 1e-12);
  EXPECT_NEAR(field.minCoeff(), -0.15, 1e-12);
}

TEST(BackgroundField, OfATiltRisesFromSideToSide) {
  const Surface surface = tissue();
  const Field field = background_field(
      surface, std::vector<Background>{Tilt{.height = 0.8, .direction = Vec3(0.0, 2.0, 0.0)}});
  EXPECT_NEAR(field[surface.nearest_vertex(kMiddle)], 0.0, 1e-12);
  EXPECT_NEAR(field.maxCoeff(), 0.4, 1e-12);
  EXPECT_NEAR(field.minCoeff(), -0.4, 1e-12);
}

// A sum of forty waves is normal with the sd asked for over many seeds: of 200 draws at one place
// the sd is known to 5 %, four times which is allowed.
TEST(BackgroundField, OfATextureHasItsStandardDeviation) {
  const Surface surface = tissue();
  const int here = surface.nearest_vertex(kMiddle);
  double squares = 0.0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
    squares += std::pow(
        background_field(surface, std::vector<Background>{Texture{.sd = 0.1, .seed = seed}})[here],
        2);
  EXPECT_NEAR(std::sqrt(squares / 200.0), 0.1, 0.02);
}

TEST(BackgroundField, RefusesWhatHasNoWidth) {
  const Surface surface = tissue();
  const auto made = [&](const Background& term) {
    return background_field(surface, std::vector<Background>{term});
  };
  EXPECT_THROW(made(Wave{.height = 0.3, .length_m = 0.0}), InvalidInput);
  EXPECT_THROW(made(Vessel{.height = 0.3}), InvalidInput);
  EXPECT_THROW(made(Tilt{.height = 0.3, .direction = Vec3::Zero()}), InvalidInput);
  EXPECT_THROW(made(Texture{.sd = std::numeric_limits<double>::quiet_NaN()}), InvalidInput);
  EXPECT_THROW(
      Phantom(surface,
              PhantomDesign{.lumps = {{.outline = Disk{kMiddle, 0.006}, .contrast = 0.0}}}),
      InvalidInput);
}

}  // namespace
}  // namespace palpation
