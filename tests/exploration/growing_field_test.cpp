// A learned field that grows by what is felt, until other hyperparameters gain enough.
#include <gtest/gtest.h>

#include "belief/dense.h"
#include "belief/tissue.h"
#include "palpation/base/error.h"
#include "palpation/exploration/exploration.h"
#include "palpation/world/phantom.h"

namespace palpation {
namespace {

constexpr double kGain = 0.5;

Hyperparameters in_force(const Belief& belief) {
  return {belief.prior().kernel().length_m, belief.prior().kernel().signal_sd,
          belief.options().noise_sd};
}

/// Hyperparameters after each batch of a run over a disk; `check` sees the belief.
std::vector<Hyperparameters> explored(const Surface& tissue, double rebuild_gain, bool foresees,
                                      const std::function<void(const Belief&)>& check = {}) {
  const Phantom phantom(tissue, {Disk{Vec3(0.0115, 0.030, 0.0), 0.00625}}, {.noise = 0.05});
  Random random(3);
  const Probe probe = [&](const SurfacePoint& where, const Vec3&) {
    return std::optional(phantom.touch(where, random));
  };
  Exploration exploration(tissue, {.field = {.economy = {.rebuild_gain = rebuild_gain}}},
                          {.batches = 8});
  std::vector<Hyperparameters> all;
  for (auto stops = exploration.next(); !stops.empty(); stops = exploration.next()) {
    if (foresees) exploration.foresee();
    exploration.record(travel(tissue, stops, std::nullopt, probe, 0.0).palpations);
    all.push_back(in_force(exploration.conclusion().belief));
    if (check) check(exploration.conclusion().belief);
  }
  return all;
}

int changes(const std::vector<Hyperparameters>& all) {
  int count = 0;
  for (std::size_t i = 1; i < all.size(); ++i) count += all[i].length_m != all[i - 1].length_m;
  return count;
}

TEST(GrowingField, IsTheFieldOfHyperparametersThatAreNearlyTheBest) {
  const Surface tissue = plane(26, 51);
  const auto all = explored(tissue, kGain, false, [](const Belief& belief) {
    const auto learned = [&](const Hyperparameters& start) {
      return learn(belief.prior(), belief.palpations(), start, {});
    };
    const Learned from_there = learned(in_force(belief));
    EXPECT_LT(learned({}).log_posterior - (from_there.log_posterior - from_there.gain), kGain);
    const Belief anew = Belief(belief.prior(), belief.options()).condition_on(belief.palpations());
    expect_alike(belief.at_vertices(), anew.at_vertices(), 1e-9);
  });
  EXPECT_GT(changes(all), 0);
  EXPECT_LT(changes(all), changes(explored(tissue, 0.0, false)));
}

TEST(GrowingField, IsForeseenWithoutAChange) {
  const Surface tissue = plane(26, 51);
  Marginals with, without;
  explored(tissue, kGain, true, [&](const Belief& belief) { with = belief.at_vertices(); });
  explored(tissue, kGain, false, [&](const Belief& belief) { without = belief.at_vertices(); });
  expect_alike(with, without, 1e-9);
}

}  // namespace
}  // namespace palpation
