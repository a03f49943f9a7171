/// A belief from readings that come late: where they belong is learned together with the field.
#pragma once

#include <optional>

#include "exploration/field_fit.h"
#include "palpation/belief/lag.h"
#include "palpation/certainty/edge_belief.h"
#include "palpation/certainty/misfit.h"

namespace palpation {

struct LagFit {
  FieldFit field;            ///< its belief knows the readings where they belong
  std::optional<Lag> lag{};  ///< nothing where it was to be learned and no reading tells
};

/// `palpations` as they were made. A lag to be learned is profiled with the field's hyperparameters
/// held, then these are learned anew, and again until it rests, from the mean of its prior on.
/// Without a lag the same as fit_field.
LagFit fit_lagged(const Surface& surface, const FieldModel& field,
                  std::span<const Palpation> palpations);

/// How late the belief's readings come, where that is likelier than that they do not by more than
/// chance makes it. Asked where they follow each other closely, or the edge hints at one. Nothing
/// where a lag is modelled.
std::optional<Misfit> lag_seen(const FieldModel& field, const EdgeBelief& edge,
                               const Belief& belief);

}  // namespace palpation
