// How a walk moves what is left of changes: tissue, a lag, gains; and places that wander.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "certainty/outline_walk.h"

namespace palpation {
namespace {

constexpr double kTradedGain = 0.2;
constexpr int kRescaled = 4;
constexpr std::size_t kOneIn = 2;  ///< one way in so many is tried a sweep

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

void OutlineWalk::wander() {
  if (chain_.profile().wandering.is_none()) return;
  auto& [of_each, lasting] = lengths_.of_ways;
  const auto way = [&](double length) {
    return Vec2(length * random_.normal(), length * random_.normal());
  };
  const auto any_of = [&](const std::vector<double>& lengths) {
    return static_cast<std::size_t>(random_.below(static_cast<int>(lengths.size())));
  };
  for (std::size_t i = 0; i < of_each.size(); i += kOneIn) {
    const std::size_t reading = any_of(of_each);
    double& length = of_each[reading];
    tune(length, chain_.wander(reading, way(length), random_), kOfNodes, 1.0);
  }
  for (std::size_t i = 0; i < lasting.size(); i += kOneIn) {
    const std::size_t term = any_of(lasting);
    double& length = lasting[term];
    tune(length, chain_.wander_lasting(static_cast<Eigen::Index>(term), way(length), random_),
         kOfNodes, 1.0);
  }
  chain_.redraw_lasting_ways(random_);
  scale_ways();
  wander_with_nodes();
}

/// With and without their readings: neither alone goes far where ways are well known, or not at all
/// (Yu and Meng 2011).
void OutlineWalk::scale_ways() {
  constexpr std::array kKinds = {&Wandering::of_each, &Wandering::lasting};
  for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
    if (lengths_.of_ways[kind].empty()) continue;
    for (int i = 0; i < kRescaled; ++i) {
      const auto terms = static_cast<double>(lengths_.of_ways[kind].size());
      chain_.rescale_ways(kKinds[kind], random_.normal() / std::sqrt(terms), random_);
    }
    Wandering other = chain_.profile().wandering;
    (other.*kKinds[kind]).log_scale += lengths_.of_way_scales[kind] * random_.normal();
    tune(lengths_.of_way_scales[kind],
         chain_.wander_with_nodes(other, chain_.outline().place, random_), kOfNumbers, 1.0);
  }
}

/// Where all places wander alike, readings tell nothing of the outline's own place.
void OutlineWalk::wander_with_nodes() {
  double& length = lengths_.of_wandering_with_nodes;
  const Vec2 way = length * random_.normal() * direction_of(random_);
  Wandering other = chain_.profile().wandering;
  other.lasting.terms += same_way_ * way.transpose() / std::exp(other.lasting.log_scale);
  std::vector<Vec2> places = chain_.outline().place;
  for (Vec2& place : places) place += way;
  tune(length, chain_.wander_with_nodes(other, places, random_), kOfNodes, kMost_m);
}

}  // namespace palpation
