#include "certainty/outline_model.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "base/normal.h"
#include "base/sigmoid.h"
#include "palpation/belief/lag.h"

namespace palpation {
namespace {

constexpr double kTurnLogSd = 1.0;  ///< of the turns' half width
constexpr double kOfSides = 0.25;   ///< that of a polygon's sides, over that of what curves
constexpr double kBendLogSd = 1.0;
constexpr double kSmooth = 0.5;         ///< part of the outlines; the rest are of the other kinds
constexpr double kPlateau = 2.0 / 3.0;  ///< part of the tumours that are as equation 4 has them
constexpr double kSigmoid = 0.5;        ///< part of those whose edge is a sigmoid
constexpr double kSigmoidLogSd = 0.06;  ///< of shoulder and skirt there
constexpr double kUnbentLogSd = 0.25;   ///< of those of any edge between plateaus
constexpr double kBentLogSd = 0.5;      ///< elsewhere
constexpr double kTop = 0.8;  ///< of the way up from the boundary, where one without is deepest
constexpr double kPieceLogSd = 0.25;    ///< of pieces in a loop
constexpr double kContrastLogSd = 0.3;  ///< of a part's contrast, about the strongest's
constexpr double kWanderingLogSd = 1.2;
constexpr int kPerLogarithm = 16;  ///< turns, whose density is a number by far

/// sinh(power asinh t) / power
double bent(double t, double power) {
  const double away = std::abs(t),
               grown = std::exp(power * std::log(away + std::sqrt(away * away + 1.0)));
  return std::copysign((grown - 1.0 / grown) / (2.0 * power), t);
}

double logit(double share) { return std::log(share / (1.0 - share)); }

/// Of lines of so many nodes, how densely they end where they began, in direction and place, but
/// for a factor. Turns' sums are taken for normal, and so is where the line ends. Given that turns
/// sum to whole ones, the directions of two pieces differ from an even loop's by an angle whose
/// variance is that times the nodes between them on either side, over all nodes. Right to a factor
/// of two, where the density falls by thousands, and to one of ten for polygons, few of whose turns
/// make the sum (outline_shape_test.cpp).
double log_density_of_closing(int nodes, const TurnLaw& law, double log_spacing) {
  double square = std::exp(kPieceLogSd * kPieceLogSd);  // of the end's place, over pieces and nodes
  for (int apart = 1; apart < nodes; ++apart)
    square += std::exp(-0.5 * law.variance * apart * (nodes - apart) / nodes) *
              std::cos(2.0 * std::numbers::pi * apart / nodes);
  return -half_square(law.off_closed) / (nodes * law.variance) - 0.5 * std::log(law.variance) -
         2.0 * log_spacing - std::log(square);
}

/// Of shoulder and skirt, where they spread so.
double bend_density(const OutlineProfile& profile, double log_sd) {
  return std::exp(-half_square(profile.log_powers.x() / log_sd) -
                  half_square(profile.log_powers.y() / log_sd)) /
         (2.0 * std::numbers::pi * log_sd * log_sd);
}

/// Of the log density, less.
double off_prior(const Wandering::Ways& ways, const Wandering::Ways& median) {
  return 0.5 * ways.terms.squaredNorm() +
         half_square((ways.log_scale - median.log_scale) / kWanderingLogSd);
}

double median_log_turn(const OutlineProfile& profile, const OutlinePrior& prior) {
  return prior.median.turns.log_half_width +
         (profile.turns.kind == LineKind::Polygonal ? std::log(kOfSides) : 0.0);
}

/// Of a slope's logarithm, but for its spread.
double slope_density(const OutlineProfile& profile, double log_median, const SlopePrior& prior) {
  return std::exp(-half_square((profile.log_slope - log_median) / prior.log_sd));
}

/// Of a tumour with such bends, such a slope and a plateau, and of one without.
struct Kinds {
  double with, without;
  Kinds(const OutlineProfile& profile, const OutlinePrior& prior)
      : with(kPlateau *
             (kSigmoid * bend_density(profile, kSigmoidLogSd) +
              (1.0 - kSigmoid) * bend_density(profile, kUnbentLogSd)) *
             slope_density(profile, prior.median.log_slope, prior.slope)),
        without((1.0 - kPlateau) * bend_density(profile, kBentLogSd) *
                slope_density(profile, log_slope_without(prior), prior.slope)) {}
  double both() const { return with + without; }

 private:
  static double log_slope_without(const OutlinePrior& prior) {
    const double top = prior.fraction + kTop * (1.0 - prior.fraction);
    return std::log((logit(top) - logit(prior.fraction)) / prior.slope.deepest_m);
  }
};

}  // namespace

ReadingLaw law_of(const OutlineProfile& profile, const OutlinePrior& prior) {
  ReadingLaw law{.low = profile.low,
                 .slope_per_m = std::exp(profile.log_slope),
                 .shoulder = std::exp(profile.log_powers.x()),
                 .skirt = std::exp(profile.log_powers.y()),
                 .logit_fraction = logit(prior.fraction),
                 .lean = profile.lean.value_or(Lean::Zero()),
                 .middle = prior.middle,
                 .radius_m = prior.radius_m,
                 .contrast = {},
                 .gain = {}};
  for (const double log_contrast : profile.log_contrast)
    law.contrast.push_back((profile.high - profile.low) * std::exp(log_contrast));
  for (const std::vector<int>& changes : prior.epochs) {
    double log_gain = 0.0;
    for (const int change : changes) log_gain += profile.log_gain[change];
    law.gain.push_back(std::exp(log_gain));
  }
  law.core = profile.core;
  if (law.core) law.in_core = law.core->stadium();
  return law;
}

double steepness_at(const ReadingLaw& law, const Vec2& place) {
  if (law.lean.isZero(0.0)) return 1.0;
  return std::exp(log_steepness(law.lean, place - law.middle, law.radius_m));
}

double share_at(const ReadingLaw& law, double depth_m, double steepness) {
  const double steps = law.slope_per_m * steepness * depth_m;
  return sigmoid(bent(steps, steps > 0.0 ? law.shoulder : law.skirt) + law.logit_fraction);
}

double share_by_core(const ReadingLaw& law, const Vec2& place, double depth_m, double share) {
  const double in_core_m = law.in_core.depth_at(place),
               in_outline = sigmoid(law.slope_per_m * depth_m), beside = law.core->beside;
  if (in_core_m >= depth_m || in_outline == 0.0) return share;
  return share * (beside + (1.0 - beside) * sigmoid(law.slope_per_m * in_core_m) / in_outline);
}

double depth_where(const ReadingLaw& law, double share, double steepness) {
  const double steps = logit(share) - law.logit_fraction,
               power = steps > 0.0 ? law.shoulder : law.skirt;
  return bent(power * steps, 1.0 / power) / (law.slope_per_m * steepness * power);
}

Vec2 way_of(const Wandering& wandering, const OutlineReadings& readings, Eigen::Index reading) {
  const auto& [of_each, lasting] = wandering;
  return std::exp(of_each.log_scale) * readings.ways.own[reading] *
             of_each.terms.row(reading).transpose() +
         std::exp(lasting.log_scale) *
             (readings.ways.lasting.row(reading) * lasting.terms).transpose();
}

double turn_at(const OutlineNodes& outline, int node) {
  const Vec2 &here = outline.place[node], in = here - outline.place[outline.before(node)],
             out = outline.place[outline.next(node)] - here;
  return std::atan2(cross(in, out), in.dot(out));
}

double log_turns_density(const OutlineNodes& outline, int first, int count,
                         const OutlineProfile& profile) {
  const TurnDensity density(profile.turns);
  const NodeLoop& loop = outline.loops[outline.loop_of[first]];
  const double even = loop.turns * 2.0 * std::numbers::pi / loop.count;
  double here = turn_at(outline, first), sum = 0.0, product = 1.0;
  if (count != loop.count)
    product = density.of_bend(here - turn_at(outline, outline.before(first)));
  for (int i = 0, node = first; i < count; ++i) {
    node = outline.next(node);
    const double after = turn_at(outline, node);
    product *= density.at(here, even) * density.of_bend(after - here);
    if (i % kPerLogarithm == kPerLogarithm - 1) sum += std::log(std::exchange(product, 1.0));
    here = after;
  }
  return sum + std::log(product);
}

double log_length_density(const Vec2& from, const Vec2& to, double log_spacing) {
  const double log_length = 0.5 * std::log((to - from).squaredNorm());
  // Lognormal; once over the length for the logarithm, once for the end's direction.
  return -half_square((log_length - log_spacing) / kPieceLogSd) - 2.0 * log_length;
}

double log_shape_density(const OutlineNodes& outline, const OutlineProfile& profile) {
  const TurnLaw law = turn_law(profile.turns);
  double sum = 0.0;
  for (std::size_t i = 0; i < outline.loops.size(); ++i) {
    const auto [first, count, part, turns] = outline.loops[i];
    sum += log_turns_density(outline, first, count, profile) - count * law.log_share -
           log_density_of_closing(count, law, profile.log_spacing[i]);
    for (int node = first; node < first + count; ++node)
      sum += log_length_density(outline.place[node], outline.place[outline.next(node)],
                                profile.log_spacing[i]);
  }
  return sum;
}

LineKind draw_line_kind(Random& random) {
  if (random.uniform() < kSmooth) return LineKind::Smooth;
  return random.uniform() < 0.5 ? LineKind::Angular : LineKind::Polygonal;
}

double log_profile_density(const OutlineProfile& profile, const OutlinePrior& prior) {
  const OutlineProfile& median = prior.median;
  double sum =
      half_square((profile.low - median.low) / prior.plateaus.low_sd) +
      half_square((profile.high - median.high) / prior.plateaus.high_sd) +
      half_square((profile.turns.log_half_width - median_log_turn(profile, prior)) / kTurnLogSd) +
      half_square((profile.turns.log_bend - median.turns.log_bend) / kBendLogSd);
  if (profile.lean) sum -= log_density(*profile.lean);
  for (std::size_t loop = 0; loop < profile.log_spacing.size(); ++loop)
    sum += half_square((profile.log_spacing[loop] - median.log_spacing[loop]) / prior.size_log_sd) +
           std::log(prior.size_log_sd / kLeastSizeLogSd);
  for (std::size_t part = 1; part < profile.log_contrast.size(); ++part)
    sum += half_square(profile.log_contrast[part] / kContrastLogSd);
  for (std::size_t change = 0; change < profile.moved_m.size(); ++change) {
    const bool is_late = prior.changes[change] == MisfitKind::Late;
    sum += half_square((profile.moved_m[change] - median.moved_m[change]).norm() /
                       (is_late ? LagPrior{}.sd_m : kMoveSd_m));
  }
  for (std::size_t change = 0; change < profile.log_gain.size(); ++change)
    sum += half_square(profile.log_gain[change] / prior.gain_log_sd[change]);
  sum += off_prior(profile.wandering.of_each, median.wandering.of_each) +
         off_prior(profile.wandering.lasting, median.wandering.lasting);
  const double of_core =
      profile.core ? log_core_density(*profile.core, prior.middle, prior.radius_m, prior.fraction)
                   : 0.0;
  return std::log(Kinds(profile, prior).both()) - sum + of_core;
}

double plateau_probability(const OutlineProfile& profile, const OutlinePrior& prior) {
  const Kinds kinds(profile, prior);
  return kinds.with / kinds.both();
}

}  // namespace palpation
