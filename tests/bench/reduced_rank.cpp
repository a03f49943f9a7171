// What thousands of readings along a path cost the exact belief and that of reduced rank, and how
// far the two are apart. Seconds are those of the processor, one thread; the exact belief is
// measured up to the second number and extrapolated beyond: to build it costs n^2, to grow it by
// ten readings n. Never part of ctest.
//
//   cmake --build build/release --target bench_reduced_rank && taskset -c 1
//   build/release/bin/bench_reduced_rank [tolerance] [most exact]

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <vector>

#include "palpation/base/parallel.h"
#include "palpation/belief/belief.h"
#include "palpation/geometry/make_plane.h"

using namespace palpation;

namespace {

constexpr int kBatch = 10;
constexpr int kUpdates = 5;
constexpr double kNoiseSd = 0.01;

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// A probe drawn over the tissue in forty rows.
std::vector<Palpation> scanned(const Surface& surface, int count) {
  Random random(5);
  std::vector<Palpation> readings;
  for (int i = 0; i < count; ++i) {
    const double along = 40.0 * (i + 0.5) / count, row = std::floor(along), x = along - row;
    const Vec3 place(0.025 * (static_cast<int>(row) % 2 == 0 ? x : 1.0 - x),
                     0.050 * (row + 0.5) / 40.0, 0.0);
    Palpation palpation;
    palpation.where = surface.project(place);
    const double distance_m = (place - Vec3(0.0115, 0.030, 0.0)).norm();
    palpation.reading =
        1.0 / (1.0 + std::exp(1400.0 * (distance_m - 0.00625))) + kNoiseSd * random.normal();
    readings.push_back(palpation);
  }
  return readings;
}

struct Cost {
  double build = 0.0, update = 0.0;
};

/// Built from all readings but the last fifty, then grown by ten at a time: the median.
Cost cost_of(Belief& belief, std::span<const Palpation> readings) {
  Cost cost;
  const std::size_t most = readings.size() - kBatch * kUpdates;
  const double start = seconds();
  belief = belief.condition_on(readings.first(most));
  cost.build = seconds() - start;
  std::vector<double> updates;
  for (int i = 0; i < kUpdates; ++i) {
    const double before = seconds();
    belief =
        belief.condition_on(readings.subspan(most + static_cast<std::size_t>(i * kBatch), kBatch));
    belief.at_vertices();
    updates.push_back(seconds() - before);
  }
  std::sort(updates.begin(), updates.end());
  cost.update = updates[kUpdates / 2];
  return cost;
}

}  // namespace

int main(int argc, char** argv) {
  const double tolerance = argc > 1 ? std::atof(argv[1]) : 1e-10;
  const int most_exact = argc > 2 ? std::atoi(argv[2]) : 2000;
  set_thread_count(1);
  Random random(3);
  const Surface surface(make_plane({.columns = 200, .rows = 200, .jitter = 0.2}, random));
  const Prior prior(surface, Metric::Chart, {.length_m = 0.0033}, {.sd = 0.0});
  std::printf("%d vertices, tolerance %g; build [s], ten more readings and the posterior [s]\n",
              surface.vertex_count(), tolerance);
  std::optional<Cost> last_exact;
  double last_count = 0.0;
  for (const int count : {1000, 2000, 5000, 10000}) {
    const std::vector<Palpation> readings = scanned(surface, count);
    Belief reduced(prior, {.noise_sd = kNoiseSd, .reduced_rank_tolerance = tolerance});
    const Cost ours = cost_of(reduced, readings);
    const std::optional<ReducedRank> rank = reduced.reduced_rank();
    std::printf("n %5d  reduced: rank %4d  build %6.2f  update %6.4f\n", count,
                rank ? rank->rank : 0, ours.build, ours.update);
    Cost exact;
    if (count <= most_exact) {
      Belief belief(prior, {.noise_sd = kNoiseSd});
      exact = cost_of(belief, readings);
      const Marginals a = belief.at_vertices(), b = reduced.at_vertices();
      std::printf("         apart: mean %.1e, variance %.1e; proved: %.1e, %.1e\n",
                  (a.mean - b.mean).cwiseAbs().maxCoeff(),
                  (a.variance - b.variance).cwiseAbs().maxCoeff(), rank ? rank->mean_error : 0.0,
                  rank ? rank->variance_error : 0.0);
      last_exact = exact;
      last_count = count;
    } else if (last_exact) {
      const double growth = count / last_count;
      exact = {last_exact->build * growth * growth, last_exact->update * growth};
    }
    std::printf("         exact%s: build %6.2f (%.0f x)  update %6.4f (%.1f x)\n",
                count <= most_exact ? "" : ", extrapolated", exact.build, exact.build / ours.build,
                exact.update, exact.update / ours.update);
  }
}
