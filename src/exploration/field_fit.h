/// A belief from readings: what is to be learned is learned.
#pragma once

#include <span>

#include "palpation/exploration/exploration.h"

namespace palpation {

/// A belief to start from: what is learned has no value yet, so the priors' medians stand in.
Belief unlearned(const Surface& surface, const FieldModel& field);

/// A belief of fixed hyperparameters from all readings, with the slope where it is modelled and may join.
Belief fixed_field(const Surface& surface, const FieldModel& field, std::span<const Palpation> palpations);

/// The readings that are not set aside.
std::vector<double> used_readings(std::span<const Palpation> palpations);

bool all_equal(const std::vector<double>& readings);

struct FieldFit {
  Belief belief;
  Hyperparameters learned;
  double signal_evidence = 0.0;  ///< log likelihood ratio of this field to noise alone around a constant, or around a plane
};

/// A new belief with the hyperparameters that the readings teach, searched from `start`; from fewer than two places, or readings that are
/// all alike, nothing is learned.
FieldFit fit_field(const Surface& surface, const FieldModel& field, std::span<const Palpation> palpations, const Hyperparameters& start);

}  // namespace palpation
