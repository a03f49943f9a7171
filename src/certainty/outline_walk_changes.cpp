// How a walk moves what is left of changes: tissue, a lag, gains.
#include <algorithm>
#include <utility>
#include <vector>

#include "certainty/outline_walk.h"

namespace palpation {
namespace {

constexpr double kTradedGain = 0.2;

}  // namespace

void OutlineWalk::move_changes() {
  for (std::size_t change = 0; change < lengths_.of_changes.size(); ++change) {
    double& length = lengths_.of_changes[change];
    const double step = length * random_.normal();
    OutlineProfile profile = chain_.profile();
    switch (chain_.prior().changes[change]) {
      case MisfitKind::Moved: {
        const Vec2 next = profile.moved_m[change] + step * direction_of(random_);
        tune(length, chain_.move_tissue(static_cast<int>(change), next, random_), kOfNodes,
             kMost_m);
        move_with_nodes(change);
        break;
      }
      case MisfitKind::Late: {
        const Vec2 next = profile.moved_m[change] + Vec2(step, 0.0);
        tune(length, chain_.move_tissue(static_cast<int>(change), next, random_), kOfNumbers,
             kMost_m);
        break;
      }
      case MisfitKind::Gain:
        profile.log_gain[change] += step / kFirst_m;
        tune(length, chain_.move_profile(profile, false, random_), kOfNumbers, kFirst_m);
        trade_gain(change);
        break;
      default:
        break;  // the background's
    }
  }
}

/// What was felt since lies as far from the outline there, where before it nobody felt that.
void OutlineWalk::move_with_nodes(std::size_t change) {
  double& length = lengths_.of_moves[change];
  const Vec2 way = length * random_.normal() * direction_of(random_);
  std::vector<Vec2> places = chain_.outline().place;
  for (std::size_t node = 0; node < places.size(); ++node)
    places[node] += felt_since_[change][node] * way;
  const Vec2 next = chain_.profile().moved_m[change] + way;
  tune(length, chain_.move_tissue_and_nodes(static_cast<int>(change), next, places, random_),
       kOfNodes, kMost_m);
}

/// Of a change and the next gain: what is felt after both may tell of neither alone.
void OutlineWalk::trade_gain(std::size_t change) {
  const std::vector<MisfitKind>& kinds = chain_.prior().changes;
  const auto next = std::find(kinds.begin() + static_cast<std::ptrdiff_t>(change) + 1, kinds.end(),
                              MisfitKind::Gain);
  if (next == kinds.end()) return;
  const double step = kTradedGain * random_.normal();
  OutlineProfile profile = chain_.profile();
  profile.log_gain[change] += step;
  profile.log_gain[static_cast<std::size_t>(next - kinds.begin())] -= step;
  chain_.move_profile(profile, false, random_);
}

}  // namespace palpation
