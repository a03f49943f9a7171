#include "certainty/outline_pruning.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "certainty/outline_lines.h"
#include "certainty/outline_walk.h"

namespace palpation {
namespace {

constexpr int kSettling = 150, kBetween = 10;  ///< sweeps
constexpr int kStates = 5;

/// An outline, with what of the prior and of a profile is of its loops and parts.
struct Loops {
  OutlineNodes outline;
  OutlinePrior prior;
  OutlineProfile profile;
};

/// A part's outer line takes its holes along.
bool goes_with(const NodeLoop& loop, const NodeLoop& lost) {
  return loop.first == lost.first || (lost.turns > 0.0 && loop.part == lost.part);
}

Loops without(const Loops& all, const NodeLoop& lost) {
  Loops kept{.outline = {}, .prior = all.prior, .profile = all.profile};
  kept.profile.log_contrast.clear();
  kept.profile.log_spacing.clear();
  kept.prior.median.log_spacing.clear();
  std::vector<int> part_now(all.profile.log_contrast.size(), -1);
  for (std::size_t i = 0; i < all.outline.loops.size(); ++i) {
    const NodeLoop& loop = all.outline.loops[i];
    if (goes_with(loop, lost)) continue;
    int& part = part_now[loop.part];
    if (part < 0) {
      part = static_cast<int>(kept.profile.log_contrast.size());
      kept.profile.log_contrast.push_back(all.profile.log_contrast[loop.part]);
    }
    kept.outline.add(line_of(all.outline, loop), part);
    kept.profile.log_spacing.push_back(all.profile.log_spacing[i]);
    kept.prior.median.log_spacing.push_back(all.prior.median.log_spacing[i]);
  }
  if (kept.profile.core) {
    const int part = part_now[kept.profile.core->part];
    if (part < 0)
      kept.profile.core.reset();
    else
      kept.profile.core->part = part;
  }
  kept.prior.median.log_contrast.resize(kept.profile.log_contrast.size());
  return kept;
}

double length_of(const OutlineNodes& outline, const NodeLoop& loop) {
  double length = 0.0;
  for (int node = loop.first; node < loop.first + loop.count; ++node)
    length += (outline.place[outline.next(node)] - outline.place[node]).norm();
  return length;
}

double price_of(const OutlineNodes& outline, const NodeLoop& loop, std::size_t readings) {
  return price_of_loop(length_of(outline, loop), ShapePrior{}, readings);
}

double price_of_losing(const OutlineNodes& outline, const NodeLoop& lost, std::size_t readings) {
  double price = 0.0;
  for (const NodeLoop& loop : outline.loops)
    price += goes_with(loop, lost) ? price_of(outline, loop, readings) : 0.0;
  return price;
}

/// Where a walk has come to.
struct State {
  Loops loops;
  OutlineCuts cuts;
  OutlineResiduals residuals;
};

/// Of the readings, by what else they are off by in that state.
double evidence_of(const OutlineReadings& readings, const State& state, const Loops& loops) {
  return OutlineChain(readings, loops.prior, loops.outline, loops.profile, state.cuts,
                      &state.residuals)
      .log_evidence();
}

/// The loop that the readings pay the least for, and without which they say more, on average over
/// states: in one or the other, a sound reading in it tells nothing. 0 for none.
std::size_t unpaid_loop(const OutlineReadings& readings, const std::vector<State>& states) {
  std::vector<double> gained(states.front().loops.outline.loops.size(), 0.0);
  for (const State& state : states) {
    const double with_all = evidence_of(readings, state, state.loops);
    for (std::size_t i = 1; i < gained.size(); ++i) {
      const NodeLoop& loop = state.loops.outline.loops[i];
      gained[i] += evidence_of(readings, state, without(state.loops, loop)) - with_all +
                   price_of_losing(state.loops.outline, loop, readings.places.size());
    }
  }
  return static_cast<std::size_t>(std::ranges::max_element(gained) - gained.begin());
}

}  // namespace

double price_of_loops(const OutlineNodes& outline, std::size_t readings) {
  double price = 0.0;
  for (const NodeLoop& loop : outline.loops) price += price_of(outline, loop, readings);
  return price;
}

OutlineStart pruned(OutlineStart start, std::uint64_t seed) {
  Loops first{std::move(start.outline), std::move(start.prior), std::move(start.profile)};
  for (bool loses = true; loses && first.outline.loops.size() > 1;) {
    OutlineWalk walk(start.readings, first.prior, first.outline, first.profile, seed);
    walk.settle(kSettling);
    std::vector<State> states;
    for (int i = 0; i < kStates; ++i) {
      walk.settle(kBetween);
      const OutlineChain& chain = walk.chain();
      states.push_back(
          {{chain.outline(), first.prior, chain.profile()}, chain.cuts(), chain.residuals()});
    }
    loses = false;
    while (const std::size_t unpaid = unpaid_loop(start.readings, states)) {
      for (State& state : states)
        state.loops = without(state.loops, state.loops.outline.loops[unpaid]);
      first = without(first, first.outline.loops[unpaid]);
      loses = true;
    }
  }
  start.outline = std::move(first.outline);
  start.prior = std::move(first.prior);
  start.profile = std::move(first.profile);
  return start;
}

}  // namespace palpation
