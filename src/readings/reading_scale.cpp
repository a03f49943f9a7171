#include "palpation/readings/reading_scale.h"

#include <cmath>

#include "palpation/readings/screening.h"

namespace palpation {

double on_scale(ReadingScale scale, double reading) {
  return scale == ReadingScale::Log ? std::log(reading) : reading;
}

double as_reading(ReadingScale scale, double value) {
  return scale == ReadingScale::Log ? std::exp(value) : value;
}

double reading_per_step(ReadingScale scale, double value) {
  return scale == ReadingScale::Log ? std::exp(value) : 1.0;
}

std::vector<Palpation> on_scale(ReadingScale scale, std::vector<Palpation> palpations) {
  if (scale == ReadingScale::Raw) return palpations;
  for (Palpation& one : palpations) {
    if (one.kind == TouchKind::Missed) continue;
    const double reading = one.reading;
    if (!(reading > 0.0)) {
      one.reading = 0.0;  // of a set aside one, which nothing looks at
      if (one.set_aside.empty()) one.set_aside = reading < 0.0 ? kNoLogarithm : kNoContact;
      continue;
    }
    one.reading = std::log(reading);
    one.noise_variance /= reading * reading;
  }
  return palpations;
}

}  // namespace palpation
