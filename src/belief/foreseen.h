/// Rows of touches that are planned but not yet made.
#pragma once

#include <memory>
#include <vector>

#include "belief/rows.h"

namespace palpation {

struct Belief::Foreseen {
  std::vector<Place> places;
  std::vector<double> diagonal;
  std::shared_ptr<const Rows> rows;
  std::shared_ptr<const Sums> sums;  // of readings without meaning: all but the whitened ones count
};

}  // namespace palpation
