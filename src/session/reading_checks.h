/// What of a reading is refused, and where on the tissue it lies.
#pragma once

#include <optional>
#include <string>

#include "io/landing.h"
#include "palpation/session/session_state.h"

namespace palpation {

/// Throws InvalidInput, in the name of `function`, unless its numbers are what measurements.h
/// allows.
void check(const SessionReading& reading, const std::string& function);

/// A person's words as a cell of a table: one line, at most 200 bytes; `standard` where there are
/// none.
std::string one_line(const std::string& words, const std::string& standard);

/// Whether a reading is told again: alike in everything, the stop only if both name one.
bool is_same(const SessionReading& a, const SessionReading& b);

/// Of these stops the one nearest to a place, within kStopReach_m.
std::optional<int> nearest_stop(const Vec3& on_tissue, const std::vector<int>& open,
                                const std::vector<Vec3>& stops);

}  // namespace palpation
