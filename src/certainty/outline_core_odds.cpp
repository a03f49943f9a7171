#include "certainty/outline_core_odds.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/sigmoid.h"
#include "certainty/outline_lines.h"
#include "certainty/outline_pruning.h"
#include "certainty/outline_walk.h"

namespace palpation {
namespace {

constexpr double kFalseAlarms = 0.02;
constexpr double kLevel = 0.9;  ///< of the way up: it levels off
constexpr double kSeldom = 0.05;
constexpr int kSettling = 150, kWeighed = 50;  ///< sweeps

const double kChance = -std::log(kFalseAlarms);
const double kRuledOut = std::log(1000.0);  ///< by odds of a thousand to one

/// Of a number that is normal with variance 1, e to its entropy, squared.
constexpr double kNormal = 2.0 * std::numbers::pi * std::numbers::e;

/// Counts what readings lie on plateaus of an outline as it is, and on one beside its core: there
/// each may read anything on the way from there to the core, or as noise scatters about one height.
void count_plateaus(const OutlineChain& chain, const OutlineReadings& readings,
                    std::vector<SettledReading>& counts) {
  const ReadingLaw& law = chain.law();
  const OutlineNodes& outline = chain.outline();
  const double noise = std::exp(chain.residuals().log_noise());
  for (std::size_t i = 0; i < readings.places.size(); ++i) {
    const Vec2& place = readings.places[i];
    const double depth = depth_in(outline, place);
    if (share_at(law, depth, steepness_at(law, place)) < kLevel) continue;
    counts[i].on_plateau += 1.0 / kWeighed;
    const int part = outline.loops[outline.loop_of[nearest_piece(outline, place).piece]].part;
    if (!law.has_core(part)) continue;
    if (sigmoid(law.slope_per_m * law.in_core.depth_at(place)) > 1.0 - kLevel) continue;
    const double way = law.contrast[part] * (1.0 - law.core->beside),
                 scatter = noise * std::sqrt(kNormal * readings.variance[i]);
    counts[i].alike += std::max(std::log(way / scatter), 0.0) / kWeighed;
  }
}

/// Numbers as a walk had them, in the sweeps in which there were any, and their prior's logarithm.
template <int kNumbers>
class Room {
 public:
  void add(const Eigen::Matrix<double, kNumbers, 1>& numbers, double log_prior) {
    numbers_.row(count_++) = numbers.transpose();
    log_prior_ += log_prior;
  }

  /// How much less room for them readings leave than there was beforehand, nats, not positive: the
  /// entropy of a normal law of their covariance less that which the prior would give them there;
  /// times the part of the sweeps in which there were any.
  double log_room() const {
    if (count_ <= kNumbers) return 0.0;
    const auto had = numbers_.topRows(count_);
    const Eigen::Matrix<double, Eigen::Dynamic, kNumbers> off =
        had.rowwise() - had.colwise().mean();
    const Eigen::Matrix<double, kNumbers, kNumbers> covariance =
        kNormal / (count_ - 1.0) * off.transpose() * off;
    const double volume = std::max(covariance.determinant(), std::numeric_limits<double>::min());
    return static_cast<double>(count_) / kWeighed *
           std::min(log_prior_ / count_ + 0.5 * std::log(volume), 0.0);
  }

 private:
  Eigen::Matrix<double, kWeighed, kNumbers> numbers_;
  double log_prior_ = 0.0;
  int count_ = 0;
};

/// But for its direction, which a round one has not.
Eigen::Vector<double, 5> numbers_of(const OutlineCore& core) {
  Eigen::Vector<double, 5> numbers;
  numbers << core.middle, core.log_radius, core.half_length_m, core.beside;
  return numbers;
}

double log_density(const OutlineCore& core, const OutlinePrior& prior) {
  return log_core_density(core, prior.middle, prior.radius_m, prior.fraction);
}

/// Of all of the profile but a core and a lean.
double log_density_but_room(OutlineProfile profile, const OutlinePrior& prior) {
  profile.core.reset();
  profile.lean.reset();
  return log_profile_density(profile, prior);
}

/// How surely walks so short tell odds, nats: a thousand to one are twice that.
const double kOddsSd = 0.5 * kRuledOut;

/// Whether they end elsewhere, by more than both spread.
bool are_apart(const SettledOutline& some, const SettledOutline& others) {
  return std::abs(some.area_m2 - others.area_m2) > some.area_sd_m2 + others.area_sd_m2;
}

/// The most by which its being of two heights may be more probable, nats: what is level is of one,
/// and of what two heights explain the more, it is there the less often (Savage and Dickey's
/// ratio).
double most_gained(const SettledOutline& of_two) {
  return of_two.level > 0.0 ? std::log(of_two.level_beforehand / of_two.level)
                            : std::numeric_limits<double>::infinity();
}

/// By how much two heights are more probable than one, nats.
double gained_by_two(const SettledOutline& of_one, const SettledOutline& of_two) {
  return std::min(of_two.log_odds + alike(of_one, of_two) - of_one.log_odds, most_gained(of_two));
}

}  // namespace

SettledOutline settled(const OutlineStart& start, std::uint64_t seed) {
  OutlineWalk walk(start.readings, start.prior, start.outline, start.profile, seed);
  walk.settle(kSettling, kSettling / 2);
  SettledOutline sum;
  sum.readings.resize(start.readings.places.size());
  Room<5> cores;
  Room<4> leans;
  double square_m4 = 0.0;
  for (int i = 0; i < kWeighed; ++i) {
    walk.settle(1);
    const OutlineChain& chain = walk.chain();
    const double area_m2 = enclosed_area(chain.outline());
    sum.log_odds +=
        (chain.residuals().log_density() + log_density_but_room(chain.profile(), start.prior) -
         price_of_loops(chain.outline(), start.readings.places.size())) /
        kWeighed;
    sum.has_plateau += plateau_probability(chain.profile(), start.prior) / kWeighed;
    sum.area_m2 += area_m2 / kWeighed;
    square_m4 += area_m2 * area_m2 / kWeighed;
    count_plateaus(chain, start.readings, sum.readings);
    const OutlineProfile& profile = chain.profile();
    if (profile.lean) leans.add(*profile.lean, log_density(*profile.lean));
    if (!profile.core) continue;
    cores.add(numbers_of(*profile.core), log_density(*profile.core, start.prior));
    if (profile.core->beside > kLevel) sum.level += 1.0 / kWeighed;
  }
  sum.level_beforehand = (1.0 - kLevel) / (1.0 - least_beside(start.prior.fraction));
  sum.area_sd_m2 = std::sqrt(std::max(square_m4 - sum.area_m2 * sum.area_m2, 0.0));
  sum.log_odds += cores.log_room() + leans.log_room();
  return sum;
}

double alike(const SettledOutline& of_one, const SettledOutline& of_two) {
  double sum = 0.0;
  for (std::size_t i = 0; i < of_one.readings.size(); ++i)
    sum += (1.0 - of_one.readings[i].on_plateau) * of_two.readings[i].alike;
  return sum;
}

double area_between(const SettledOutline& of_one, const SettledOutline& of_two) {
  if (!are_apart(of_one, of_two) || of_two.area_m2 < of_one.area_m2) return 0.0;
  return (of_one.area_m2 * of_two.area_sd_m2 + of_two.area_m2 * of_one.area_sd_m2) /
         (of_one.area_sd_m2 + of_two.area_sd_m2);
}

/// An outline of one height follows such readings as lie on a plateau beside the core by fingers,
/// and could have followed any: that they read alike speaks for the core. Where that is not surely
/// so, tissue may as well rise all the way up to its middle: then readings that make a core more
/// probable tell neither, unless one height has a plateau all the same, and is ruled out twice
/// over. Nor do those that do not, where the two end elsewhere, unless they rule a second height
/// out.
Heights heights_by(const SettledOutline& of_one, const SettledOutline& of_two) {
  const double by_alike = alike(of_one, of_two), gained = gained_by_two(of_one, of_two);
  const bool rules_one_out = by_alike > kChance
                                 ? gained > kRuledOut
                                 : of_one.has_plateau > 0.5 && gained > 2.0 * kRuledOut;
  if (of_two.level < kSeldom && rules_one_out) return Heights::Two;
  const bool is_open = gained > kChance || (are_apart(of_one, of_two) && gained > -kRuledOut);
  return is_open ? Heights::OneOrTwo : Heights::One;
}

/// Of odds that are not surely known the mean, by MacKay's approximation (1992) of a sigmoid over a
/// normal law. Where readings make two more probable, and still tell neither, it is a half.
double probability_of_two(const SettledOutline& of_one, const SettledOutline& of_two) {
  const double gained = std::min(gained_by_two(of_one, of_two), 0.0);
  return sigmoid(gained / std::sqrt(1.0 + std::numbers::pi / 8.0 * kOddsSd * kOddsSd));
}

}  // namespace palpation
