// Where a chain's loops may lie: each holds a reading, in each other as at first.
#include <algorithm>

#include "certainty/outline_chain.h"

namespace palpation {

int OutlineChain::holder_of(const Felt& felt) const {
  const int nearest = outline_.loop_of[felt.nearest.piece];
  const bool is_hole = outline_.loops[nearest].turns < 0.0;
  if (!felt.inside) return is_hole ? nearest : -1;
  if (!is_hole) return nearest;
  const auto outer =
      std::ranges::find(outline_.loops, outline_.loops[nearest].part, &NodeLoop::part);
  return static_cast<int>(outer - outline_.loops.begin());
}

std::vector<int> OutlineChain::held_in(const std::vector<Felt>& felt) const {
  std::vector<int> held(outline_.loops.size(), 0);
  for (const Felt& one : felt) {
    if (const int loop = holder_of(one); loop >= 0) ++held[loop];
  }
  return held;
}

/// Whether no loop loses its last reading.
bool OutlineChain::may_hold(const std::vector<int>& held) const {
  return std::ranges::equal(held, held_, [](int then, int now) { return then > 0 || now == 0; });
}

bool OutlineChain::is_nested_as_before() const {
  return outline_.loops.size() == 1 || nesting_of(outline_) == nesting_;
}

}  // namespace palpation
