/// Screening in the loop.
#pragma once

#include <span>
#include <vector>

#include "palpation/exploration/model.h"

namespace palpation {

/// The readings, screened where the field asks for it; else those that are implausible are set
/// aside. Where a lag is modelled they are compared at the places
/// where they belong with this one, whatever their direction of travel.
std::vector<Palpation> screened_readings(const Surface& surface, const FieldModel& field,
                                         std::span<const Palpation> recorded, double lag_m);

}  // namespace palpation
