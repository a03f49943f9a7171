/// A belief of reduced rank: many readings in few numbers.
#pragma once

#include <memory>

#include "belief/features.h"
#include "belief/weight_space.h"
#include "palpation/belief/belief.h"

namespace palpation {

struct Belief::Reduced {
  std::shared_ptr<const Features> features;
  WeightSpace weights;
  int site_count = 0;      // of places touched, each counted anew in every call of condition_on
  double signal_sd = 1.0;  // that the noise is counted in
  bool noise_keeps_pace = true;  // with the signal's: all relative to it
  double precision = 0.0;        // sum 1 / d
  double scatter = 0.0;          // log likelihood of the readings given those merged
};

}  // namespace palpation
