/// Whether tissue slopes, weighed against tissue that does not.
#pragma once

#include <functional>
#include <vector>

#include "exploration/as_if_unchanged.h"

namespace palpation {

/// What readings say, their sessions' and the sensor's zeros taken back.
using KnownOf = std::function<Known(const std::vector<Palpation>& palpations)>;

/// What is known of readings `felt` without their slope, which is the first of what is taken back;
/// `flat` as it is where no slope makes them more probable than an edge alone does, by more than
/// chance and the freedom to choose it (Schwarz's, of two numbers).
Known without_tilt(const Surface& surface, const Model& model, const std::vector<Palpation>& felt,
                   Known flat, const KnownOf& known_of);

}  // namespace palpation
