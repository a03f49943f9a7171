// From readings to the field, and whether it shows more than noise.
#include <cmath>
#include <tuple>
#include <utility>

#include "certainty/contrast.h"
#include "certainty/detection.h"
#include "exploration/field_fit.h"
#include "exploration/heavy_tails.h"
#include "exploration/lag_fit.h"
#include "palpation/exploration/exploration.h"
#include "palpation/readings/screening.h"
#include "readings/readings.h"

namespace palpation {
namespace {

/// The fourth changes weights by less than a part in ten.
constexpr int kRoundsOfWeighing = 4;
constexpr std::size_t kFewReadings = 10;
/// What lies farther from others than so many times their span is no plateau of which they felt the
/// edge.
constexpr double kFarAlone = 10.0;

/// Of the palpations that are not set aside.
std::optional<LoneReading> lone_palpation(std::span<const Palpation> palpations) {
  std::optional<LoneReading> lone = lone_reading(used_readings(palpations));
  if (!lone) return std::nullopt;
  std::size_t number = 0;
  for (std::size_t used = 0; !palpations[number].set_aside.empty() || used < lone->number; ++number)
    used += palpations[number].set_aside.empty();
  lone->number = number;
  return lone;
}

/// A smooth field is slow to believe in a few readings of many; a disk is not.
bool a_disk_stands_out(const Layout& layout, std::span<const Palpation> palpations) {
  const std::vector<double> readings = used_readings(palpations);
  if (readings.size() < kFewReadings) return false;
  return greatest_excess(layout, layout.touched(palpations), readings) > kNeededToFind;
}

}  // namespace

/// The field by all readings, of which the last ones are `fresh`; returns the evidence for it,
/// where it is learned. While a reading stands alone, what is used of the others may change: then
/// nothing grows.
double Exploration::believe(std::span<const Palpation> all, std::span<const Palpation> fresh) {
  const FieldModel& field = model_.field;
  const bool grows = !lone_reading_;
  if (field.learns() || field.probe.has_lag() || field.probe.screening || field.noise.heavy_tails) {
    LagFit fit = may_grow(field) && grows
                     ? LagFit{grow_field(surface_, field, all, belief_, learned_), {}}
                     : fit_lagged(surface_, field, all, learned_, lag_);
    belief_ = std::move(fit.field.belief);
    learned_ = fit.field.learned;
    if (field.probe.has_lag()) lag_ = fit.lag;
    if (field.noise.heavy_tails) weigh_for_heavy_tails(all);
    return fit.field.signal_evidence;
  }
  belief_ = trend_is_missing() || !grows ? fixed_field(surface_, field, all)
                                         : belief_.condition_on(fresh);
  return 0.0;
}

/// `evidence`: for the field, where it is learned.
bool Exploration::shows_contrast(std::span<const Palpation> all, double evidence) const {
  const FieldModel& field = model_.field;
  std::vector<Palpation> flat = field.trend.is_linear
                                    ? belief_.detrended_palpations()
                                    : std::vector<Palpation>(all.begin(), all.end());
  if (field.noise.heavy_tails) flat = drawn_in(std::move(flat));
  if (!field.learns()) {
    evidence = evidence_of_fixed(belief_, flat);
  } else if (field.noise.heavy_tails) {
    evidence = fit_field(surface_, field, flat, learned_).signal_evidence;
  }
  if (a_disk_stands_out(Layout(belief_.prior()), flat)) return true;
  // Values alone are no contrast where noise may have heavy tails: what is drawn in gathers at both
  // ends.
  return field.noise.heavy_tails ? shows_field(evidence)
                                 : palpation::shows_contrast(used_readings(flat), evidence);
}

/// Asked anew after every batch: what ten readings of noise once seemed to show, more readings
/// there take back. Nor is it contrast what one of many readings shows alone: where the others show
/// it, and that one is nothing like them, it is set aside.
void Exploration::judge_contrast(std::vector<Palpation>& all, double evidence) {
  const FieldModel& field = model_.field;
  const std::optional<LoneReading> lone =
      lone_palpation(field.trend.is_linear ? belief_.detrended_palpations() : all);
  if (lone && model_.needs_contrast()) {
    const auto with_it = std::tuple(belief_, learned_, lag_);
    all[lone->number].set_aside = kStandsAlone;
    evidence = believe(all, {});
    contrast_seen_ = shows_contrast(all, evidence);
    if (!contrast_seen_ || lone->spans <= kFarAlone) {
      all[lone->number].set_aside.clear();
      std::tie(belief_, learned_, lag_) = with_it;
    }
  } else if (model_.needs_contrast()) {
    contrast_seen_ = shows_contrast(all, evidence);
  }
  lone_reading_ = lone ? std::optional(all[lone->number]) : std::nullopt;
}

/// Weights and field in turn; the readings stay where the lag that was found puts them.
void Exploration::weigh_for_heavy_tails(std::span<const Palpation> palpations) {
  const FieldModel& field = model_.field;
  FieldModel given = field;
  given.noise.is_relative = false;
  const std::vector<Palpation> placed = displaced(surface_, palpations, lag_ ? lag_->value_m : 0.0);
  double noise_sd = std::sqrt(belief_.noise_variance());
  for (int round = 0; round < kRoundsOfWeighing; ++round) {
    const WeighedReadings weighed = weighed_for_heavy_tails(belief_, placed, noise_sd);
    noise_sd = field.noise.sd.is_learned() ? weighed.noise_sd : noise_sd;
    given.noise.sd = noise_sd;
    belief_ = given.learns() ? fit_field(surface_, given, weighed.palpations, learned_).belief
                             : fixed_field(surface_, given, weighed.palpations);
  }
}

}  // namespace palpation
