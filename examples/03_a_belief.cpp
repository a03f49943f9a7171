// What readings say about the stiffness elsewhere, and what one more touch would add: a belief is a
// value, and a copy of it a thought experiment. Usage: 03_a_belief
#include <cmath>
#include <cstdio>

#include "palpation/palpation.h"

using namespace palpation;

int main() {
  Random random(1);
  const Surface tissue(make_plane({.columns = 26, .rows = 51}, random));
  const Prior prior(tissue, Metric::Chart,
                    {.family = KernelFamily::Matern52, .length_m = 0.0035, .signal_sd = 1.0});

  Palpation soft, stiff;
  soft.where = tissue.at_vertex(tissue.nearest_vertex(Vec3(0.005, 0.025, 0.0)));
  soft.reading = 7.0;
  stiff.where = tissue.at_vertex(tissue.nearest_vertex(Vec3(0.015, 0.025, 0.0)));
  stiff.reading = 9.0;
  const Belief belief = Belief(prior, {.noise_sd = 0.1}).condition_on(std::vector{soft, stiff});

  const SurfacePoint between = tissue.at_vertex(tissue.nearest_vertex(Vec3(0.010, 0.025, 0.0)));
  const auto tell = [&](const char* when, const Belief& now) {
    const Marginals here = now.at(std::span(&between, 1));
    std::printf("%s: %.2f +- %.2f\n", when, here.mean[0], std::sqrt(here.variance[0]));
  };
  tell("between the two touches", belief);

  Palpation supposed;
  supposed.where = between;
  supposed.reading = 8.5;
  tell("supposing 8.5 were felt there", belief.condition_on(std::span(&supposed, 1)));
  tell("but nobody touched it", belief);
}
