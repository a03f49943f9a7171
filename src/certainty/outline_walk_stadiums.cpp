// How a walk moves what is a stadium: cuts, and a core.
#include "certainty/outline_walk.h"

namespace palpation {
namespace {

constexpr int kSwitches = 3;  ///< of each cut, a sweep

}  // namespace

void OutlineWalk::move_core() {
  if (!chain_.profile().core) return;
  for (int i = 0; i < kOfCore; ++i) {
    OutlineProfile profile = chain_.profile();
    OutlineCore& core = *profile.core;
    double* const number[kOfCore] = {&core.middle.x(),    &core.middle.y(), &core.log_radius,
                                     &core.half_length_m, &core.angle,      &core.beside};
    *number[i] += lengths_.of_core[i] * random_.normal();
    tune(lengths_.of_core[i], chain_.move_profile(profile, false, random_), kOfNumbers, 1.0);
  }
}

void OutlineWalk::move_cuts() {
  for (int which = 0; which < kCuts; ++which) {
    for (int i = 0; i < kSwitches; ++i) chain_.switch_cut(which, random_);
    for (int i = 0; i < kOfCut && chain_.cuts()[which].is_present; ++i) {
      OutlineCut next = chain_.cuts()[which];
      double& length = lengths_.of_cuts[i];
      const double step = length * random_.normal();
      if (i == 0) next.offset += step * direction_of(random_);
      if (i == 1) next.log_radius += step;
      if (i == 2) next.half_length_m += step;
      if (i == 3) next.angle += step;
      tune(length, chain_.move_cut(which, next, random_), kOfNumbers, 10.0);
      chain_.anchor_anew(which, random_);
    }
  }
}

}  // namespace palpation
