// Outlines as polygons that are drawn from their posterior: depths by hand, steps against the whole
// density, draws against closed forms.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "certainty/outline_chain.h"
#include "certainty/outline_walk.h"
#include "certainty/wandering.h"

namespace palpation {
namespace {

constexpr double kMm = 1e-3;

OutlineNodes rectangle(double width_m, double height_m, int nodes) {
  OutlineNodes outline;
  outline.add(
      evenly_spaced({Vec2(0, 0), Vec2(width_m, 0), Vec2(width_m, height_m), Vec2(0, height_m)},
                    nodes),
      0);
  return outline;
}

/// In a square from there on: 7 where a share of 2 is nothing, with noise.
OutlineReadings felt_in(double from_mm, double size_mm, int count, double noise,
                        const std::function<double(const Vec2& place)>& share, Random& random) {
  OutlineReadings readings;
  for (int i = 0; i < count; ++i) {
    const Vec2 place =
        kMm * Vec2(from_mm + size_mm * random.uniform(), from_mm + size_mm * random.uniform());
    readings.places.push_back(place);
    readings.reading.push_back(7.0 + 2.0 * share(place) + noise * random.normal());
    readings.variance.push_back(noise * noise);
  }
  return readings;
}

double sigmoid_of(double steps) { return 1.0 / (1.0 + std::exp(-steps)); }

/// Over and beside a rectangle of 8 by 8 mm, as its profile would feel them.
OutlineReadings felt_around(const OutlineNodes& outline, int count, Random& random) {
  const auto share = [&](const Vec2& place) {
    return sigmoid_of(1200.0 * depth_in(outline, place));
  };
  return felt_in(-4.0, 16.0, count, 0.1, share, random);
}

OutlinePrior prior_of(const OutlineNodes& outline) {
  OutlinePrior prior;
  prior.median = {.low = 7.0,
                  .high = 9.0,
                  .log_slope = std::log(1200.0),
                  .turns = {.log_half_width = std::log(0.12)},
                  .log_spacing = std::vector(outline.loops.size(), std::log(kMm)),
                  .log_contrast = {0.0, 0.0}};
  prior.plateaus = {.low_sd = 0.5, .high_sd = 0.5};
  prior.residuals.wild_density = 1.0 / 3.0;
  return prior;
}

TEST(OutlineNodes, DepthIsTheSignedDistance) {
  const OutlineNodes square = rectangle(8 * kMm, 8 * kMm, 32);
  EXPECT_NEAR(depth_in(square, kMm * Vec2(4, 3)), 3 * kMm, 1e-15);
  EXPECT_NEAR(depth_in(square, kMm * Vec2(-2, 4)), -2 * kMm, 1e-15);
  EXPECT_NEAR(depth_in(square, kMm * Vec2(11, 12)), -5 * kMm, 1e-15);  // from a corner
}

TEST(OutlineNodes, AHoleIsOutside) {
  OutlineNodes ring = rectangle(8 * kMm, 8 * kMm, 32);
  ring.add({kMm * Vec2(3, 3), kMm * Vec2(3, 5), kMm * Vec2(5, 5), kMm * Vec2(5, 3)}, 0);
  EXPECT_EQ(ring.loops[1].turns, -1.0);
  EXPECT_NEAR(depth_in(ring, kMm * Vec2(4, 4)), -1 * kMm, 1e-15);
  EXPECT_NEAR(depth_in(ring, kMm * Vec2(4, 2)), 1 * kMm, 1e-15);
}

ReadingLaw bent_law(double log_shoulder, double log_skirt) {
  OutlinePrior prior;
  prior.fraction = 0.3;
  const OutlineProfile profile{.low = 7.0,
                               .high = 9.0,
                               .log_slope = std::log(1200.0),
                               .log_powers = {log_shoulder, log_skirt},
                               .log_spacing = {std::log(kMm)},
                               .log_contrast = {0.0}};
  return law_of(profile, prior);
}

TEST(ReadingLaw, UnbentIsEquationFour) {
  const ReadingLaw law = bent_law(0.0, 0.0);
  for (const double depth : {-20 * kMm, -1.3 * kMm, 0.0, 0.4 * kMm, 15 * kMm}) {
    const double share = 1.0 / (1.0 + std::exp(-1200.0 * depth - std::log(0.3 / 0.7)));
    EXPECT_NEAR(share_at(law, depth), share, 1e-14);
  }
}

// At great depths bent(t) is close to (2 t)^k / (2 k): log odds of shares are known by hand.
TEST(ReadingLaw, GoesOnAsAPowerOfTheDepthOnEitherSide) {
  const ReadingLaw law = bent_law(std::log(0.5), std::log(0.25));
  const auto bend = [&](double depth) {
    const double share = share_at(law, depth);
    return std::log(share / (1.0 - share)) - std::log(0.3 / 0.7);
  };
  EXPECT_NEAR(bend(100 * kMm), std::pow(240.0, 0.5), 0.07);
  EXPECT_NEAR(bend(-100 * kMm), -4.0 * std::sinh(0.25 * std::asinh(120.0)), 1e-9);
  EXPECT_NEAR(bend(0.001 * kMm), 0.0012, 1e-9);  // as steep at the boundary as unbent
}

TEST(ReadingLaw, HasEachShareAtOneDepth) {
  for (const double log_shoulder : {-1.5, 0.0, 0.9}) {
    const ReadingLaw law = bent_law(log_shoulder, 0.6);
    for (const double share : {0.001, 0.1, 0.3, 0.5, 0.97})
      EXPECT_NEAR(share_at(law, depth_where(law, share)), share, 1e-12);
  }
}

TEST(ReadingLaw, IsSteeperTowardsASide) {
  OutlinePrior prior = prior_of(rectangle(8 * kMm, 8 * kMm, 32));
  prior.middle = {0.1, 0.2};
  prior.radius_m = 4 * kMm;
  OutlineProfile profile = prior.median;
  profile.lean = Lean(0.4, 0.0, 0.0, 0.0);
  const ReadingLaw law = law_of(profile, prior);
  EXPECT_EQ(steepness_at(law, Vec2(0.1, 0.2)), 1.0);
  EXPECT_NEAR(steepness_at(law, Vec2(-0.9, 0.2)), std::exp(-0.4), 1e-4);
  EXPECT_EQ(share_at(law, kMm, 2.0), share_at(law, 2 * kMm));
  EXPECT_NEAR(depth_where(law, 0.7, 2.0), 0.5 * depth_where(law, 0.7), 1e-15);
}

/// Whose median slope is, without a plateau, e to so many standard deviations gentler.
OutlinePrior gentler_without(double deviations) {
  OutlinePrior prior = prior_of(rectangle(8 * kMm, 8 * kMm, 32));
  prior.slope.deepest_m = std::log(9.0) / 1200.0 * std::exp(deviations * prior.slope.log_sd);
  return prior;
}

// Shares of normal densities, by hand: at no bend 1/3 / .06^2 + 1/3 / .25^2 against 1/3 / .5^2.
TEST(OutlineProfile, IsTheLikelierToHaveAPlateauTheLessItIsBent) {
  const OutlinePrior prior = gentler_without(0.0);
  OutlineProfile profile = prior.median;
  const double sigmoid = 1.0 / (0.06 * 0.06), unbent = 1.0 / (0.25 * 0.25),
               bent = 1.0 / (0.5 * 0.5);
  EXPECT_NEAR(plateau_probability(profile, prior), (sigmoid + unbent) / (sigmoid + unbent + bent),
              1e-12);
  profile.log_powers.x() = 0.5;  // over 8 sd of a sigmoid's
  EXPECT_NEAR(plateau_probability(profile, prior), unbent / (unbent + bent * std::exp(1.5)), 1e-12);
  profile.log_powers.y() = -1.0;
  EXPECT_LT(plateau_probability(profile, prior), 0.01);
}

// What rises to nine tenths where it is deepest is as slow as it is wide; a plateau's edge is not.
TEST(OutlineProfile, IsTheLikelierToHaveAPlateauTheNarrowerItsEdgeIs) {
  const OutlinePrior prior = gentler_without(3.0);
  OutlineProfile profile = prior.median;
  profile.log_powers.x() = 0.5;  // where a sigmoid is out of the question
  const auto odds = [&](double deviations) {
    profile.log_slope = std::log(1200.0) - deviations * prior.slope.log_sd;
    const double probability = plateau_probability(profile, prior);
    return std::log(probability / (1.0 - probability));
  };
  EXPECT_NEAR(odds(0.0) - odds(1.5), 4.5, 1e-6);
  EXPECT_NEAR(odds(1.5) - odds(3.0), 4.5, 1e-6);
  EXPECT_NEAR(odds(1.5), std::log(4.0) - 1.5, 1e-6);  // half way, where the slope tells nothing
}

TEST(OutlineProfile, HasADensityWhereverTheBoundaryIsOnTheWayUp) {
  for (const double fraction : {1e-6, 0.1, 0.9, 0.95, 0.999999}) {
    OutlinePrior prior = gentler_without(0.0);
    prior.fraction = fraction;
    EXPECT_TRUE(std::isfinite(log_profile_density(prior.median, prior))) << fraction;
    EXPECT_GT(plateau_probability(prior.median, prior), 0.0) << fraction;
  }
}

// A hundred pieces: more than are measured at once.
TEST(OutlinePieces, AgreeWithWhatIsAskedPieceByPiece) {
  Random random(2);
  OutlineNodes ring = rectangle(8 * kMm, 8 * kMm, 90);
  for (Vec2& place : ring.place) place += 0.2 * kMm * Vec2(random.normal(), random.normal());
  ring.add({kMm * Vec2(3, 3), kMm * Vec2(3, 5), kMm * Vec2(5, 5), kMm * Vec2(5, 3)}, 0);
  OutlinePieces pieces(ring);
  for (int i = 0; i < 2000; ++i) {
    const int moved = random.below(ring.count());
    ring.place[moved] += 0.05 * kMm * Vec2(random.normal(), random.normal());
    for (const int piece : {moved, ring.before(moved)})
      pieces.set(piece, ring.place[piece], ring.place[ring.next(piece)]);
    const Vec2 place = kMm * Vec2(-4.0 + 16.0 * random.uniform(), -4.0 + 16.0 * random.uniform());
    const NearestPiece nearest = nearest_piece(ring, place);
    ASSERT_NEAR(pieces.nearest(place).square, nearest.square, 1e-18);
    ASSERT_EQ(pieces.encloses(place), is_inside(ring, place));
  }
}

TEST(OutlineNodes, NodesAreEvenlySpacedFarFromTheOrigin) {
  const Vec2 away(3.0, -2.0);
  const std::vector<Vec2> line = {away, away + Vec2(0.01, 0), away + Vec2(0.01, 0.02)};
  const std::vector<Vec2> nodes = evenly_spaced(line, 17);
  ASSERT_EQ(nodes.size(), 17u);
  EXPECT_EQ(nodes.front(), away);
  EXPECT_NEAR(enclosed_area(line), 1e-4, 1e-15);
}

/// Of the readings in their order, as many after each.
void add_changes(const std::vector<MisfitKind>& kinds, OutlineReadings& readings,
                 OutlinePrior& prior) {
  const std::size_t spans = kinds.size() + 1, count = readings.places.size();
  for (std::size_t i = 0; i < count; ++i)
    readings.epoch.push_back(static_cast<int>(i * spans / count));
  for (int change = 0; change < static_cast<int>(kinds.size()); ++change) {
    prior.epochs.push_back(prior.epochs.back());
    prior.epochs.back().push_back(change);
  }
  prior.changes = kinds;
  prior.median.moved_m.assign(kinds.size(), Vec2::Zero());
  prior.median.log_gain.assign(kinds.size(), 0.0);
  prior.gain_log_sd.assign(kinds.size(), 0.2);
}

/// As the product has it, in their order; the first is the mean of four.
void wander(OutlineReadings& readings, OutlinePrior& prior) {
  for (std::size_t i = 0; i < readings.places.size(); ++i) readings.made.push_back({{.number = i}});
  readings.made.front().resize(4, {.number = 0});
  OutlineStart start{readings, prior, {}, prior.median};
  let_wander(ways_of(readings.made), start);
  readings = start.readings;
  prior = start.prior;
}

TEST(OutlineChain, AfterAnySteppingItsDensityIsThatOfTheWhole) {
  Random random(3);
  const OutlineNodes truth = rectangle(8 * kMm, 8 * kMm, 32);
  OutlineNodes start = rectangle(7 * kMm, 9 * kMm, 32);
  start.add({kMm * Vec2(-3.5, -3), kMm * Vec2(-2, -3.5), kMm * Vec2(-2, -2), kMm * Vec2(-3, -1.5)},
            1);
  OutlineReadings readings = felt_around(truth, 80, random);
  OutlinePrior prior = prior_of(start);
  add_changes({MisfitKind::Moved, MisfitKind::Gain, MisfitKind::Late}, readings, prior);
  for (std::size_t i = 0; i < readings.places.size(); ++i)
    readings.travel.push_back(direction_of(random));
  readings.background = background_terms({.places = readings.places, .when = readings.reading});
  readings.background.median_sd = 0.1;
  wander(readings, prior);
  OutlineWalk chain(readings, prior, start, prior.median, 5);
  chain.settle(60);
  EXPECT_NE(chain.chain().residuals().log_noise(), 0.0);
  EXPECT_GT(chain.chain().profile().wandering.of_each.terms.norm(), 1.0);
  EXPECT_GT(chain.chain().profile().wandering.lasting.terms.norm(), 1.0);
  const OutlineChain fresh(readings, prior, chain.chain().outline(), chain.chain().profile(),
                           chain.chain().cuts(), &chain.chain().residuals());
  // Some 20,000 steps were taken: each adds and removes the same numbers.
  EXPECT_NEAR(chain.chain().log_density(), fresh.log_density(), 1e-9);
}

TEST(OutlineChain, LinesNeverCross) {
  Random random(4);
  OutlineNodes start = rectangle(8 * kMm, 8 * kMm, 32);
  start.add({kMm * Vec2(9, 1), kMm * Vec2(11, 1), kMm * Vec2(11, 3), kMm * Vec2(9, 3)}, 1);
  const OutlineReadings nothing;
  const OutlinePrior prior = prior_of(start);
  OutlineWalk chain(nothing, prior, start, prior.median, 6);
  for (int round = 0; round < 20; ++round) {
    chain.settle(5);
    const OutlineNodes& outline = chain.chain().outline();
    for (int a = 0; a < outline.count(); ++a) {
      for (int b = 0; b < outline.count(); ++b) {
        if (a == b || b == outline.next(a) || a == outline.next(b)) continue;
        EXPECT_FALSE(cross_each_other(outline.place[a], outline.place[outline.next(a)],
                                      outline.place[b], outline.place[outline.next(b)]));
      }
    }
  }
}

TEST(OutlineChain, ItsDensityIsTheSameWhereverTheTissueLies) {
  Random random(7);
  const OutlineNodes outline = rectangle(8 * kMm, 6 * kMm, 28);
  OutlineReadings readings = felt_around(outline, 60, random);
  const auto add_background = [&] {
    readings.background = background_terms({.places = readings.places, .when = readings.reading});
  };
  add_background();
  const OutlinePrior prior = prior_of(outline);
  const double here = OutlineChain(readings, prior, outline, prior.median).log_density();
  OutlineNodes moved = outline;
  const Eigen::Rotation2D<double> turn(0.7);
  for (Vec2& place : moved.place) place = turn * place + Vec2(0.3, -0.2);
  for (Vec2& place : readings.places) place = turn * place + Vec2(0.3, -0.2);
  add_background();
  EXPECT_NEAR(OutlineChain(readings, prior, moved, prior.median).log_density(), here, 1e-9);
}

// Where the outline is held still and nothing else is unknown, low is normal about the mean of what
// was felt outside: the conjugate posterior of a mean.
TEST(OutlineChain, APlateauIsDrawnFromItsConjugatePosterior) {
  Random random(8);
  const OutlineNodes outline = rectangle(2 * kMm, 2 * kMm, 12);
  OutlineReadings readings;
  double sum = 0.0;
  constexpr int kCount = 20;
  for (int i = 0; i < kCount; ++i) {
    readings.places.push_back(Vec2(0.1 + 0.01 * i, 0.2));  // far outside: all low
    readings.reading.push_back(7.3 + 0.1 * random.normal());
    readings.variance.push_back(0.01);
    sum += readings.reading.back();
  }
  const OutlinePrior prior = prior_of(outline);
  OutlineChain chain(readings, prior, outline, prior.median);
  const double precision = kCount / 0.01 + 1.0 / 0.25, mean = (sum / 0.01 + 7.0 / 0.25) / precision;
  constexpr int kDraws = 40'000;
  double drawn = 0.0, square = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    OutlineProfile next = chain.profile();
    next.low += 0.05 * random.normal();
    chain.move_profile(next, false, random);
    drawn += chain.profile().low / kDraws;
    square += chain.profile().low * chain.profile().low / kDraws;
  }
  const double sd = 1.0 / std::sqrt(precision);
  // Draws are correlated over some ten: four standard errors.
  EXPECT_NEAR(drawn, mean, 4.0 * sd * std::sqrt(10.0 / kDraws));
  EXPECT_NEAR(std::sqrt(square - drawn * drawn), sd, 0.08 * sd);
}

// Twelve readings, half of them inside, and all but the plateaus held still: low and high are
// normal given them, by the normal equations.
TEST(OutlineChain, PlateausAreDrawnFromWhatTheyAreGivenAllElse) {
  Random random(33);
  const OutlineNodes outline = rectangle(8 * kMm, 8 * kMm, 32);
  const OutlineReadings readings = felt_around(outline, 12, random);
  const OutlinePrior prior = prior_of(outline);
  OutlineChain chain(readings, prior, outline, prior.median);
  Eigen::Matrix2d precision = Eigen::Matrix2d::Identity() / 0.25;
  Eigen::Vector2d pull = Eigen::Vector2d(7.0, 9.0) / 0.25;
  for (std::size_t i = 0; i < readings.places.size(); ++i) {
    const double share = sigmoid_of(1200.0 * depth_in(outline, readings.places[i]));
    const Eigen::Vector2d column(1.0 - share, share);
    precision += column * column.transpose() / 0.01;
    pull += readings.reading[i] / 0.01 * column;
  }
  constexpr int kDraws = 4000;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    chain.move_whatever_plateaus(outline.place, prior.median.log_slope, random, -1e300);  // never
    const Eigen::Vector2d drawn(chain.profile().low, chain.profile().high);
    mean += drawn / kDraws;
    square += drawn * drawn.transpose() / kDraws;
  }
  const Eigen::Matrix2d expected = precision.inverse();
  EXPECT_LT((mean - expected * pull).norm(), 4.0 * std::sqrt(expected.trace() / kDraws));
  EXPECT_LT((square - mean * mean.transpose() - expected).norm(), 0.1 * expected.norm());
}

// The plateaus integrated over a grid.
TEST(OutlineChain, EvidenceIsTheDensityOverAllPlateaus) {
  Random random(34);
  const OutlineNodes outline = rectangle(8 * kMm, 8 * kMm, 32);
  const OutlineReadings readings = felt_around(outline, 12, random);
  const OutlinePrior prior = prior_of(outline);
  const auto integral = [&](const OutlineNodes& of) {
    double sum = 0.0;
    for (int low = -40; low <= 40; ++low) {
      for (int high = -40; high <= 40; ++high) {
        OutlineProfile profile = prior.median;
        profile.low += 0.02 * low;
        profile.high += 0.02 * high;
        sum += std::exp(OutlineChain(readings, prior, of, profile).log_density() -
                        log_shape_density(of, profile));
      }
    }
    return std::log(sum);
  };
  const auto evidence = [&](const OutlineNodes& of) {
    return OutlineChain(readings, prior, of, prior.median).log_evidence();
  };
  OutlineNodes smaller = outline;
  for (Vec2& place : smaller.place) place *= 0.95;
  EXPECT_NEAR(evidence(smaller) - evidence(outline), integral(smaller) - integral(outline), 0.02);
}

// Without readings the profile's draws are the prior's: of one kind in two of three, of the other,
// so many standard deviations gentler, in one.
TEST(OutlineWalk, WithoutReadingsTheSlopeIsDrawnFromItsPrior) {
  const OutlineNodes outline = rectangle(8 * kMm, 8 * kMm, 32);
  const OutlineReadings nothing;
  for (const double gentler : {0.0, 1.0}) {
    const OutlinePrior prior = gentler_without(gentler);
    OutlineWalk chain(nothing, prior, outline, prior.median, 9);
    chain.settle(300);
    double mean = 0.0, square = 0.0;
    for (const OutlineDraw& draw : chain.draws(4000, 2000)) {
      const double z = (draw.profile.log_slope - std::log(1200.0)) / prior.slope.log_sd;
      mean += z / 2000.0;
      square += z * z / 2000.0;
    }
    // Three tries a sweep: draws are correlated over three or so, a standard error of .04.
    EXPECT_NEAR(mean, -gentler / 3.0, 0.15);
    EXPECT_NEAR(square - mean * mean, 1.0 + 2.0 / 9.0 * gentler * gentler, 0.25);
  }
}

/// Around a square, all of them noise, so that what is drawn is drawn from its prior.
struct TellingNothing {
  OutlineNodes outline = rectangle(8 * kMm, 8 * kMm, 32);
  OutlineReadings readings;
  OutlinePrior prior = prior_of(outline);

  explicit TellingNothing(std::uint64_t seed) {
    Random random(seed);
    readings = felt_around(outline, 40, random);
    for (double& variance : readings.variance) variance = 1e12;
    prior.residuals.noise_log_sd = 0.01;  // else all that noise is doubted
  }
};

// Readings that tell nothing: cuts come and go as their prior has them, by whatever steps.
TEST(OutlineWalk, CutsAreDrawnFromTheirPriorWhereReadingsTellNothing) {
  auto [outline, readings, prior] = TellingNothing(12);
  OutlineWalk walk(readings, prior, outline, prior.median, 13);
  walk.settle(200);
  double present = 0.0, log_radius = 0.0, square = 0.0, length_m = 0.0;
  constexpr int kDraws = 3000;
  for (int i = 0; i < kDraws; ++i) {
    walk.draws(1, 1);
    for (const OutlineCut& cut : walk.chain().cuts()) {
      if (!cut.is_present) continue;
      const double z = (cut.log_radius - std::log(0.0035)) / 0.4;
      present += 1.0;
      log_radius += z;
      square += z * z;
      length_m += cut.half_length_m;
      EXPECT_LE(cut.offset.norm(), 1.0);
    }
  }
  // Nine thousand switches for two cuts: a standard error of .01.
  EXPECT_NEAR(present / (2 * kDraws), 0.5, 0.05);
  EXPECT_NEAR(log_radius / present, 0.0, 0.12);
  EXPECT_NEAR(std::sqrt(square / present), 1.0, 0.08);
  EXPECT_NEAR(length_m / present, 0.002, 0.0002);
}

TEST(OutlineWalk, FindsAHoleThatItsStartDoesNotKnow) {
  Random random(14);
  const OutlineNodes outline = rectangle(16 * kMm, 16 * kMm, 64);
  const auto share = [&](const Vec2& place) {
    const double from_hole = (place - kMm * Vec2(8, 8)).norm() - 4 * kMm;
    return sigmoid_of(1200.0 * std::min(depth_in(outline, place), from_hole));
  };
  const OutlineReadings readings = felt_in(-3.0, 22.0, 150, 0.2, share, random);
  const OutlinePrior prior = prior_of(outline);
  OutlineWalk walk(readings, prior, outline, prior.median, 15);
  walk.settle(300);
  int with_hole = 0;
  for (const OutlineDraw& draw : walk.draws(300, 100)) {
    with_hole += std::ranges::any_of(
        draw.cuts, [](const Stadium& cut) { return cut.depth_at(kMm * Vec2(8, 8)) > 1.5 * kMm; });
  }
  EXPECT_GE(with_hole, 95);
}

// What is felt above a small sphere, r from its middle, is (1 + r^2 / z^2)^(-3/2) of its height
// (Boussinesq 1885): no sigmoid, no plateau, and half of the height at 6 mm.
TEST(OutlineWalk, FindsWhereAHillHasHalfOfItsHeight) {
  constexpr double kHalf_m = 6 * kMm;
  const double z2 = kHalf_m * kHalf_m / (std::cbrt(4.0) - 1.0);
  Random random(16);
  const auto share = [&](const Vec2& place) {
    return std::pow(1.0 + place.squaredNorm() / z2, -1.5);
  };
  const OutlineReadings readings = felt_in(-20.0, 40.0, 200, 0.02, share, random);
  std::vector<Vec2> circle;
  for (int i = 0; i < 40; ++i) {
    const double angle = 0.05 * std::numbers::pi * i;
    circle.push_back(7 * kMm * Vec2(std::cos(angle), std::sin(angle)));
  }
  OutlineNodes start;
  start.add(circle, 0);
  const OutlinePrior prior = prior_of(start);
  OutlineWalk walk(readings, prior, start, prior.median, 17);
  walk.settle(400);
  int bent = 0;
  double radius_m = 0.0;
  const std::vector<OutlineDraw> draws = walk.draws(800, 100);
  for (const OutlineDraw& draw : draws) {
    if (draw.has_plateau) continue;
    const OutlineNodes& outline = draw.outline;
    const double reach_m = std::sqrt(std::abs(enclosed_area(outline.place)) / std::numbers::pi),
                 half = 0.5 * share_at(draw.law, depth_in(outline, Vec2(0, 0)));
    radius_m += reach_m - depth_where(draw.law, half);
    ++bent;
  }
  EXPECT_GT(bent, 50);
  EXPECT_NEAR(radius_m / bent, kHalf_m, 0.25 * kMm);
}

// One side is twice as steep as the other: with one slope for both, the outline would lie off by
// half a millimetre.
TEST(OutlineWalk, FindsASlopeForEachSide) {
  Random random(31);
  const OutlineNodes outline = rectangle(8 * kMm, 8 * kMm, 32);
  const auto share = [&](const Vec2& place) {
    const double side = std::clamp((place.x() - 4 * kMm) / (4 * kMm), -1.0, 1.0);
    return sigmoid_of(1000.0 * std::exp(0.35 * side) * depth_in(outline, place));
  };
  const OutlineReadings readings = felt_in(-4.0, 16.0, 300, 0.04, share, random);
  OutlinePrior prior = prior_of(outline);
  prior.middle = {4 * kMm, 4 * kMm};
  prior.radius_m = 4 * kMm;
  OutlineWalk walk(readings, prior, outline, prior.median, 32);
  walk.settle(400);
  const std::vector<OutlineDraw> draws = walk.draws(800, 100);
  double ratio = 0.0, across = 0.0, left = 0.0;
  for (const OutlineDraw& draw : draws) {
    ratio += std::log(steepness_at(draw.law, kMm * Vec2(8, 4)) /
                      steepness_at(draw.law, kMm * Vec2(0, 4))) /
             100.0;
    across += std::abs(draw.law.lean[1]) / 100.0;
    left += depth_in(draw.outline, kMm * Vec2(0, 4)) / 100.0;
  }
  EXPECT_NEAR(ratio, 0.7, 0.25);
  EXPECT_LT(across, 0.15);
  EXPECT_NEAR(left, 0.0, 0.2 * kMm);
}

// Tissue that moved once more than was taken back, and then a gain that changed.
TEST(OutlineWalk, FindsWhatIsLeftOfChanges) {
  Random random(21);
  const OutlineNodes outline = rectangle(8 * kMm, 8 * kMm, 32);
  OutlineReadings readings = felt_around(outline, 360, random);
  OutlinePrior prior = prior_of(outline);
  add_changes({MisfitKind::Moved, MisfitKind::Gain}, readings, prior);
  const Vec2 moved = kMm * Vec2(1.0, -0.7);
  for (std::size_t i = 0; i < readings.places.size(); ++i) {
    if (readings.epoch[i] > 0) readings.places[i] -= moved;
    if (readings.epoch[i] > 1) readings.reading[i] = 7.0 + 1.2 * (readings.reading[i] - 7.0);
  }
  OutlineWalk walk(readings, prior, outline, prior.median, 22);
  walk.settle(400);
  const std::vector<OutlineDraw> draws = walk.draws(800, 100);
  Vec2 mean = Vec2::Zero();
  double square = 0.0, gain = 0.0;
  for (const OutlineDraw& draw : draws) {
    mean += draw.profile.moved_m[0] / 100.0;
    square += (draw.profile.moved_m[0] - moved).squaredNorm() / 200.0;
    gain += std::exp(draw.profile.log_gain[1]) / 100.0;
    EXPECT_EQ(draw.profile.log_gain[0], 0.0);  // that change was a move
    EXPECT_EQ(draw.profile.moved_m[1], Vec2(0, 0));
  }
  EXPECT_LT(std::sqrt(square), 0.15 * kMm);
  EXPECT_LT((mean - moved).norm(), 4.0 * std::sqrt(square));
  EXPECT_NEAR(gain, 1.2, 0.04);
}

// Readings are of places 0.7 mm farther back than was taken back, and the probe came from anywhere.
TEST(OutlineWalk, FindsWhatIsLeftOfALag) {
  Random random(51);
  const OutlineNodes outline = rectangle(8 * kMm, 8 * kMm, 32);
  OutlineReadings readings = felt_around(outline, 300, random);
  OutlinePrior prior = prior_of(outline);
  add_changes({MisfitKind::Late}, readings, prior);
  prior.epochs = {{0}};
  readings.epoch.clear();
  constexpr double kLeft_m = 0.7 * kMm;
  for (Vec2& place : readings.places) {
    readings.travel.push_back(direction_of(random));
    place += kLeft_m * readings.travel.back();
  }
  OutlineWalk walk(readings, prior, outline, prior.median, 52);
  walk.settle(400);
  double mean_m = 0.0, square = 0.0;
  for (const OutlineDraw& draw : walk.draws(800, 100)) {
    const Vec2& left = draw.profile.moved_m[0];
    EXPECT_EQ(left.y(), 0.0);
    mean_m += left.x() / 100.0;
    square += std::pow(left.x() - kLeft_m, 2) / 100.0;
  }
  EXPECT_LT(std::sqrt(square), 0.2 * kMm);
  EXPECT_GT(std::sqrt(square), 0.01 * kMm);
  EXPECT_NEAR(mean_m, kLeft_m, 0.2 * kMm);
}

TEST(OutlineWalk, WhatIsLeftOfAMoveIsDrawnFromItsPriorWhereReadingsTellNothing) {
  auto [outline, readings, prior] = TellingNothing(23);
  add_changes({MisfitKind::Moved}, readings, prior);
  OutlineWalk walk(readings, prior, outline, prior.median, 24);
  walk.settle(300);
  double square = 0.0;
  const std::vector<OutlineDraw> draws = walk.draws(6000, 2000);
  for (const OutlineDraw& draw : draws) square += draw.profile.moved_m[0].squaredNorm() / 2000.0;
  // Of two directions, 3 mm in each. Draws are correlated over some ten: a standard error of a
  // tenth.
  EXPECT_NEAR(std::sqrt(0.5 * square), 3 * kMm, 0.45 * kMm);
}

// About an outline that stays: where that goes anywhere, it holds readings the more often the
// farther those may lie.
TEST(OutlineChain, WanderingIsDrawnFromItsPriorWhereReadingsTellNothing) {
  auto [outline, readings, prior] = TellingNothing(27);
  wander(readings, prior);
  OutlineChain chain(readings, prior, outline, prior.median);
  Random random(28);
  constexpr int kSteps = 10'000;
  constexpr std::array kKinds = {&Wandering::of_each, &Wandering::lasting};
  std::array<double, 2> mean{}, square{}, norm{};
  for (int i = 0; i < kSteps; ++i) {
    const auto any = [&] { return Vec2(random.normal(), random.normal()); };
    for (int step = 0; step < 4; ++step) {
      chain.wander(static_cast<std::size_t>(random.below(40)), any(), random);
      chain.wander_lasting(random.below(static_cast<int>(readings.ways.lasting.cols())), any(),
                           random);
    }
    chain.redraw_lasting_ways(random);
    for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
      chain.rescale_ways(kKinds[kind], 0.15 * random.normal(), random);
      Wandering other = chain.profile().wandering;
      (other.*kKinds[kind]).log_scale += random.normal();
      chain.wander_with_nodes(other, outline.place, random);
      const Wandering::Ways& ways = chain.profile().wandering.*kKinds[kind];
      const double off = ways.log_scale - (prior.median.wandering.*kKinds[kind]).log_scale;
      mean[kind] += off / kSteps;
      square[kind] += off * off / kSteps;
      norm[kind] += ways.terms.squaredNorm() / static_cast<double>(ways.terms.size()) / kSteps;
    }
  }
  for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
    EXPECT_NEAR(mean[kind], 0.0, 0.1);
    EXPECT_NEAR(std::sqrt(square[kind]), 1.2, 0.08);
    EXPECT_NEAR(norm[kind], 1.0, 0.02);
  }
}

// Beyond the readings none contradicts it: steps into any direction would be taken.
TEST(OutlineWalk, AnOutlineHoldsAReadingEvenWhereReadingsTellNothing) {
  auto [outline, readings, prior] = TellingNothing(25);
  outline.add({kMm * Vec2(1, 1), kMm * Vec2(1, 7), kMm * Vec2(7, 7), kMm * Vec2(7, 1)}, 0);
  prior.median.log_spacing.push_back(std::log(kMm));
  OutlineWalk walk(readings, prior, outline, prior.median, 26);
  walk.settle(500);
  for (const OutlineDraw& draw : walk.draws(1000, 50)) {
    for (const NodeLoop& loop : draw.outline.loops) {
      OutlineNodes alone;
      const auto first = draw.outline.place.begin() + loop.first;
      alone.add({first, first + loop.count}, 0);
      EXPECT_TRUE(std::ranges::any_of(readings.places,
                                      [&](const Vec2& place) { return is_inside(alone, place); }));
    }
  }
}

TEST(OutlineWalk, TheSameSeedDrawsTheSame) {
  Random random(10);
  const OutlineNodes truth = rectangle(8 * kMm, 8 * kMm, 32);
  const OutlineReadings readings = felt_around(truth, 60, random);
  const OutlinePrior prior = prior_of(truth);
  const auto last = [&](std::uint64_t seed) {
    OutlineWalk chain(readings, prior, truth, prior.median, seed);
    chain.settle(20);
    return chain.draws(20, 5).back().outline.place[3];
  };
  EXPECT_EQ(last(1), last(1));
  EXPECT_NE(last(1), last(2));
}

}  // namespace
}  // namespace palpation
