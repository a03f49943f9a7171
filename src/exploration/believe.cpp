#include "exploration/believe.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "certainty/contrast.h"
#include "certainty/detection.h"
#include "exploration/field_fit.h"
#include "exploration/lag_fit.h"
#include "exploration/screened_readings.h"
#include "palpation/readings/screening.h"
#include "readings/readings.h"

namespace palpation {
namespace {

constexpr std::size_t kFewReadings = 10;
/// What lies farther from others than so many times their span is no plateau of which they felt the
/// edge.
constexpr double kFarAlone = 10.0;
constexpr std::ptrdiff_t kWitnesses = 3;  // nearest readings

/// Whether one of the readings nearest to one of these is another of these.
bool confirm_each_other(const Surface& surface, std::span<const Palpation> palpations,
                        std::span<const std::size_t> these) {
  if (these.size() < 2) return false;
  const auto place = [&](std::size_t i) { return surface.position(palpations[i].where); };
  for (const std::size_t here : these) {
    std::vector<std::pair<double, std::size_t>> others;
    for (std::size_t i = 0; i < palpations.size(); ++i) {
      if (i != here && counts(palpations[i]))
        others.emplace_back((place(i) - place(here)).squaredNorm(), i);
    }
    const auto most = others.begin() + std::min(kWitnesses, std::ssize(others));
    std::partial_sort(others.begin(), most, others.end());
    if (std::any_of(others.begin(), most, [&](const auto& near) {
          return std::ranges::binary_search(these, near.second);
        }))
      return true;
  }
  return false;
}

/// The most readings that stand apart, in numbers of palpations, of those that are not set aside,
/// by so many spans at least. What is felt twice side by side is no fault.
std::optional<ReadingsApart> palpations_apart(const Surface& surface,
                                              std::span<const Palpation> palpations,
                                              double least_spans) {
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < palpations.size(); ++i) {
    if (palpations[i].set_aside.empty()) used.push_back(i);
  }
  const std::vector<double> readings = used_readings(palpations);
  for (std::size_t most = few_of(readings.size()); most > 0; --most) {
    std::optional<ReadingsApart> apart = readings_apart(readings, most);
    if (!apart) return std::nullopt;
    most = apart->numbers.size();
    for (std::size_t& number : apart->numbers) number = used[number];
    if (apart->spans > least_spans && !confirm_each_other(surface, palpations, apart->numbers))
      return apart;
  }
  return std::nullopt;
}

std::vector<Palpation> without(std::vector<Palpation> palpations, const ReadingsApart& apart) {
  for (const std::size_t number : apart.numbers) palpations[number].set_aside = kStandsAlone;
  return palpations;
}

/// A smooth field is slow to believe in a few readings of many; a disk is not.
bool a_disk_stands_out(const Layout& layout, std::span<const Palpation> palpations) {
  const std::vector<double> readings = used_readings(palpations);
  if (readings.size() < kFewReadings) return false;
  return greatest_excess(layout, layout.touched(palpations), readings) > kNeededToFind;
}

/// The field by the readings that are not set aside.
LagFit fitted(const Surface& surface, const FieldModel& field, std::span<const Palpation> all,
              ConclusionCache& cache) {
  if (grows(field, all)) return {grown_field(surface, field, all, cache)};
  const bool is_given = !field.learns() && !field.probe.has_lag();
  LagFit fit =
      is_given ? LagFit{{fixed_field(surface, field, all)}} : fit_lagged(surface, field, all);
  if (!field.probe.has_lag() || all.empty()) fit.lag.reset();
  return fit;
}

/// The field by the readings that a screen leaves. Where it depends on a lag that is to be learned,
/// the readings are screened once more at the one that was found.
LagFit screened_and_fitted(const Surface& surface, const FieldModel& field,
                           std::vector<Palpation>& all, ConclusionCache& cache) {
  const std::vector<Palpation> felt = all;
  all = screened_readings(surface, field, felt, field.probe.lag_m.value_or(LagPrior{}.mean_m));
  LagFit fit = fitted(surface, field, all, cache);
  if (!field.probe.lag_m.is_learned() || !fit.lag) return fit;
  std::vector<Palpation> again = screened_readings(surface, field, felt, fit.lag->value_m);
  if (std::ranges::equal(again, all, {}, &Palpation::set_aside, &Palpation::set_aside)) return fit;
  all = std::move(again);
  return fitted(surface, field, all, cache);
}

bool shows_contrast(const FieldModel& field, const FieldFit& fit, std::span<const Palpation> all) {
  const Belief& belief = fit.belief;
  const std::vector<Palpation> flat = field.trend.is_linear
                                          ? belief.detrended_palpations()
                                          : std::vector<Palpation>(all.begin(), all.end());
  const double evidence = field.learns() ? fit.signal_evidence : evidence_of_fixed(belief, flat);
  return a_disk_stands_out(Layout(belief.prior()), flat) ||
         palpation::shows_contrast(used_readings(flat), evidence);
}

bool lacks_trend(const FieldModel& field, const Belief& belief) {
  return field.trend.is_linear && !belief.prior().has_slope();
}

}  // namespace

std::vector<Palpation> as_made(std::vector<Palpation> felt, std::span<const Palpation> believed) {
  for (std::size_t i = 0; i < felt.size(); ++i) felt[i].set_aside = believed[i].set_aside;
  return felt;
}

/// What ten readings of noise once seemed to show, more readings there take back. Nor is it
/// contrast what few of many readings show, each alone: where the others show it, and those are
/// nothing like them, they are set aside.
Believed believe(const Surface& surface, const Model& model, std::vector<Palpation> all,
                 ConclusionCache& cache) {
  const FieldModel& field = model.field;
  LagFit fit = screened_and_fitted(surface, field, all, cache);
  Evidence evidence{.contrast_seen = !model.needs_contrast(),
                    .trend_is_missing = lacks_trend(field, fit.field.belief)};
  const auto result = [&] {
    std::optional<double> of_smooth_field;
    if (field.learns()) of_smooth_field = fit.field.signal_evidence;
    return Believed{std::move(all),  std::move(fit.field.belief),    fit.lag, std::move(evidence),
                    of_smooth_field, std::move(fit.field.one_by_one)};
  };
  if (all.empty() || evidence.trend_is_missing) return result();
  const std::vector<Palpation> flat = field.trend.is_linear ? fit.field.belief.detrended(all) : all;
  const std::optional<ReadingsApart> apart = palpations_apart(surface, flat, 1.0);
  if (apart && model.needs_contrast()) {
    const std::vector<Palpation> others = without(all, *apart);
    evidence.contrast_seen =
        shows_contrast(field, fitted(surface, field, others, cache).field, others);
    const std::optional<ReadingsApart> far =
        evidence.contrast_seen ? palpations_apart(surface, flat, kFarAlone) : std::nullopt;
    if (far) {
      all = without(std::move(all), *far);
      fit = fitted(surface, field, all, cache);
    }
  } else if (model.needs_contrast()) {
    evidence.contrast_seen = shows_contrast(field, fit.field, all);
  }
  if (apart) {
    for (const std::size_t number : apart->numbers) evidence.standing_alone.push_back(all[number]);
  }
  return result();
}

}  // namespace palpation
