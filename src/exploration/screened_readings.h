/// Screening in the loop.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "palpation/exploration/exploration.h"

namespace palpation {

/// The readings, screened where the field asks for it. Where a lag is modelled they are compared at
/// the places where they belong, whatever their direction of travel.
std::vector<Palpation> screened_readings(const Surface& surface, const FieldModel& field,
                                         std::span<const Palpation> recorded,
                                         const std::optional<Lag>& before);

}  // namespace palpation
