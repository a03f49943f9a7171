#include "exploration/field_fit.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "belief/sites.h"
#include "palpation/base/error.h"
#include "readings/dense_stops.h"
#include "readings/readings.h"
#include "readings/way.h"

namespace palpation {
namespace {

/// With fewer places touched, a tumour and a tilt are told apart by chance: of simulated runs one
/// in ten went wrong.
constexpr std::size_t kPlacesForSlope = 15;
/// Standard deviation of what the slope adds from the middle of the tissue to its sides, over half
/// the contrast: 1.5, so that a tilt as large as the contrast from end to end is likely, and a
/// plane that explains the tumour away is not.
constexpr double kSlopeToHalfContrast = 1.5;
/// What half the contrast is taken for where it is not known: half of the readings' range.
constexpr double kHalf = 0.5;

/// Readings on the way this close together, over the length of the field, may be one: two of a
/// field of 3.5 mm read once per mm.
constexpr double kMergeWithin = 0.3;

constexpr std::size_t kMostForEvidence = 300;

/// Stops that three numbers are learned from: more tell them no better, and the cost grows with the
/// third power.
constexpr std::size_t kMostStops = 600;

bool is_on_the_way(const Palpation& palpation) { return palpation.kind == TouchKind::Way; }

/// Of what counts, every so many of the stops where they number more than kMostStops or `most`, and
/// of the readings on the way, so that there are no more than `most` in all if the stops allow.
std::vector<Palpation> to_learn_from(std::span<const Palpation> palpations, std::size_t most) {
  const auto used = static_cast<std::size_t>(std::ranges::count_if(palpations, counts));
  const auto ways = static_cast<std::size_t>(std::ranges::count_if(
      palpations, [](const Palpation& one) { return counts(one) && is_on_the_way(one); }));
  const std::size_t stops = used - ways, kept_stops = std::min(stops, std::max(most, kMostStops)),
                    kept_ways = std::min(ways, most > kept_stops ? most - kept_stops : 0);
  if (kept_stops == stops && (ways == 0 || used <= most))
    return {palpations.begin(), palpations.end()};
  struct Thinning {
    std::size_t kept, all, passed = 0;
    bool keeps_next() {
      ++passed;
      return passed * kept / all > (passed - 1) * kept / all;
    }
  };
  Thinning of_stops{kept_stops, stops}, of_ways{kept_ways, ways};
  std::vector<Palpation> chosen;
  for (const Palpation& palpation : palpations) {
    if (!counts(palpation)) continue;
    if ((is_on_the_way(palpation) ? of_ways : of_stops).keeps_next()) chosen.push_back(palpation);
  }
  return chosen;
}

/// The slope where it is modelled and enough places are touched, else none. `half_contrast` in the
/// units of the prior's signal.
Slope slope_of(const Surface& surface, const FieldModel& field, std::size_t places,
               double half_contrast) {
  if (!field.trend.is_linear || places < kPlacesForSlope) return {};
  return slope_across(surface, field.metric, kSlopeToHalfContrast * half_contrast);
}

Prior with_slope(const Prior& prior, const Slope& slope) {
  return prior.with(prior.kernel(), prior.constant(), slope);
}

/// Learned noise this low is kept in double, so that rounding refuses none.
constexpr double kSurelyEnoughForSingle = (1.0 + 1e-9) * kLeastNoiseForSingle;

/// What stands in for a noise until it is learned, over the signal.
constexpr double kNoiseToSignal = 0.1;

}  // namespace

Belief unlearned(const Surface& surface, const FieldModel& field) {
  const Kernel kernel = kernel_of(field.kernel);
  const BeliefOptions options{
      .noise_sd = field.noise.sd.value_or(kNoiseToSignal * kernel.signal_sd),
      .noise_is_relative = field.noise.is_relative && !field.learns(),
      .standardize = field.standardize && !field.learns(),
      .reduced_rank_tolerance = field.economy.reduced_rank_tolerance,
      .single_precision = field.economy.single_precision};
  const LengthRange lengths = field.kernel.length_m.is_learned()
                                  ? lengths_to_learn(field.kernel.length_median_m)
                                  : LengthRange{};
  return Belief(Prior(surface, field.metric, kernel, field.trend.constant, {}, lengths), options);
}

/// Half the contrast is what the signal's standard deviation stands for.
Belief fixed_field(const Surface& surface, const FieldModel& field,
                   std::span<const Palpation> palpations) {
  const Belief fresh = unlearned(surface, field);
  const std::size_t places = gather_sites(fresh.prior(), palpations).size();
  const Slope slope = slope_of(surface, field, places, fresh.prior().kernel().signal_sd);
  return Belief(with_slope(fresh.prior(), slope), fresh.options()).condition_on(palpations);
}

double evidence_of_fixed(const Belief& belief, std::span<const Palpation> palpations) {
  std::vector<Palpation> all, some;
  std::ranges::copy_if(palpations, std::back_inserter(all), counts);
  const std::size_t step = (all.size() + kMostForEvidence - 1) / kMostForEvidence;
  for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  const Prior prior = belief.prior().with(belief.prior().kernel(), {}, belief.prior().slope());
  if (gather_sites(prior, some).size() < 2) return 0.0;
  const Hyperparameters given{prior.kernel().length_m, belief.signal_sd(),
                              std::sqrt(belief.noise_variance())};
  try {
    return learn(prior, some, given,
                 {.length_m = given.length_m,
                  .signal_sd = given.signal_sd,
                  .noise_sd = given.noise_sd})
        .signal_evidence;
  } catch (const NumericalError&) {
    return 0.0;
  }
}

Hyperparameters LearnedField::in_force() const {
  if (taught) return learned;
  return {blank.prior().kernel().length_m, blank.prior().kernel().signal_sd,
          blank.options().noise_sd};
}

LearnedField learn_field(const Surface& surface, const FieldModel& field,
                         std::span<const Palpation> palpations, const Hyperparameters& start,
                         std::size_t most_places) {
  const Belief fresh = unlearned(surface, field);
  const std::vector<double> readings = used_readings(palpations);
  const std::size_t places = gather_sites(fresh.prior(), palpations).size();
  if (places < 2 || all_equal(readings)) return {fresh, start};
  LearnOptions options;
  options.length_median_m = field.kernel.length_median_m;
  options.length_m = field.kernel.length_m.given();
  options.signal_sd = field.kernel.signal_sd.given();
  options.noise_sd = field.noise.sd.given();
  if (grows(field, palpations)) options.rounding_nats = field.economy.rebuild_gain;
  // A field of zero mean around the readings' mean, if they are standardized: what is learned is in
  // reading units all the same.
  const bool centred = field.standardize && field.trend.constant.sd == 0.0;
  const Spread spread = centred ? spread_of(readings) : Spread{0.0, 1.0};
  std::vector<Palpation> shifted = to_learn_from(palpations, most_places);
  for (Palpation& palpation : shifted) palpation.reading -= spread.mean;
  const auto [least, greatest] = std::minmax_element(readings.begin(), readings.end());
  Slope slope = slope_of(surface, field, places, kHalf * (*greatest - *least));
  const Learned learned = learn(with_slope(fresh.prior(), slope), shifted, start, options);

  Kernel kernel = kernel_of(field.kernel);
  kernel.length_m = learned.values.length_m;
  kernel.signal_sd = learned.values.signal_sd / spread.sd;
  slope.sd /= spread.sd;
  const Prior prior = fresh.prior().with(kernel, field.trend.constant, slope);
  BeliefOptions believed = fresh.options();
  believed.noise_sd = learned.values.noise_sd;
  believed.standardize = centred;
  const double ratio = learned.values.noise_sd / learned.values.signal_sd;
  if (ratio * ratio < kSurelyEnoughForSingle) believed.single_precision = false;
  return {Belief(prior, believed), learned.values, learned.signal_evidence, true,
          shifted.size() < palpations.size()};
}

FieldFit fit_field(const Surface& surface, const FieldModel& field,
                   std::span<const Palpation> palpations) {
  return belief_of(surface, field, palpations, learn_field(surface, field, palpations));
}

bool grows(const FieldModel& field, std::span<const Palpation> palpations) {
  const bool restates_known_readings =
      field.probe.has_lag() || field.probe.screening || field.trend.is_linear;
  if (restates_known_readings) return false;
  return !field.learns() || (field.economy.rebuild_gain > 0.0 && field.trend.constant.sd > 0.0 &&
                             std::ranges::none_of(palpations, is_on_the_way));
}

FieldFit grown_field(const Surface& surface, const FieldModel& field,
                     std::span<const Palpation> palpations, ConclusionCache& cache) {
  if (!field.learns()) return {cache.grown(unlearned(surface, field), palpations)};
  const LearnedField taught = learn_field(surface, field, palpations);
  return {cache.grown(taught.blank, palpations), taught.signal_evidence};
}

FieldFit belief_of(const Surface& surface, const FieldModel& field,
                   std::span<const Palpation> palpations, const LearnedField& taught) {
  const auto is_stop = [](const Palpation& one) { return counts(one) && !is_on_the_way(one); };
  const bool are_dense =
      std::ranges::count_if(palpations, is_stop) > static_cast<std::ptrdiff_t>(kMostStops);
  const auto fit = [&](const LearnedField& by) -> FieldFit {
    if (!field.learns()) return {by.blank.condition_on(palpations), by.signal_evidence};
    const double within_m = kMergeWithin * kernel_of(field.kernel).length_m,
                 noise_variance = std::pow(by.in_force().noise_sd, 2);
    std::vector<Palpation> felt(palpations.begin(), palpations.end());
    if (are_dense) felt = merged_in_cells(surface, felt, within_m, noise_variance);
    if (std::ranges::none_of(felt, is_on_the_way))
      return {by.blank.condition_on(felt), by.signal_evidence};
    return {by.blank.condition_on(merged_on_the_way(surface, felt, within_m, noise_variance)),
            by.signal_evidence, std::move(felt)};
  };
  try {
    return fit(taught);
  } catch (const NumericalError&) {
    // Less noise than parts the readings that were left out: all of them together say so.
    if (!taught.from_some) throw;
    return fit(learn_field(surface, field, palpations, taught.learned, palpations.size()));
  }
}

}  // namespace palpation
