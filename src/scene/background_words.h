/// What healthy tissue, the way a sensor is held and its drift add to all readings, in words.
#pragma once

#include <string>

#include "palpation/certainty/misfit.h"
#include "palpation/readings/reading_scale.h"

namespace palpation::tool {

std::string tilt_words(ReadingScale scale, const Vec3& slope_per_m);
std::string waves_words(const Surface& surface, ReadingScale scale, const Field& waves);
std::string drift_words(ReadingScale scale, const Unevenness& background);
/// Of errors that last and were not taken back.
std::string errors_words(ReadingScale scale, const LastingErrors& errors);

}  // namespace palpation::tool
