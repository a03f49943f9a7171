// What the intrinsic metric costs beside the ambient one: to make it ready, and for one planning
// iteration of ten picks after 95 readings, with the hyperparameters fixed and with them learned.
// Never part of ctest.
//
//   cmake --build build/release --target bench_metrics && build/release/bin/bench_metrics [vertices
//   along a side] [threads]

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "geometry/spectrum.h"
#include "palpation/base/parallel.h"
#include "palpation/belief/hyperparameters.h"
#include "palpation/decision/batch.h"
#include "palpation/geometry/make_plane.h"

using namespace palpation;

namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::vector<Palpation> readings_on(const Surface& surface, int count) {
  Random random(7);
  std::vector<Palpation> readings;
  for (int i = 0; i < count; ++i) {
    Palpation palpation;
    const int vertex = random.below(surface.vertex_count());
    palpation.where = surface.at_vertex(vertex);
    const double distance_m = (surface.vertex(vertex) - Vec3(0.0115, 0.030, 0.0)).norm();
    palpation.reading =
        7.0 + 2.0 / (1.0 + std::exp(1400.0 * (distance_m - 0.00625))) + 0.1 * random.normal();
    readings.push_back(palpation);
  }
  return readings;
}

void measure(const char* name, const Surface& surface, Metric metric, bool learned) {
  constexpr double kLength_m = 0.0033;
  const double start = seconds();
  const Prior prior(surface, metric, {.length_m = kLength_m}, {}, {},
                    learned ? lengths_to_learn(0.0035) : LengthRange{});
  const Field variance = prior.raw_variance();
  const double ready = seconds();
  const std::vector<Palpation> readings = readings_on(surface, 105);
  const auto first = std::span(readings).first(95);
  const Belief before = Belief(prior, {.noise_sd = 0.1}).condition_on(first);
  std::vector<int> candidates;
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) candidates.push_back(vertex);

  const double started = seconds();
  Belief after = before;
  if (learned) {
    const Hyperparameters values = learn(prior, readings, {kLength_m, 1.0, 0.1}, {}).values;
    Kernel kernel = prior.kernel();
    kernel.length_m = values.length_m;
    kernel.signal_sd = values.signal_sd;
    after = Belief(prior.with(kernel), {.noise_sd = values.noise_sd}).condition_on(readings);
  } else {
    after = before.condition_on(std::span(readings).subspan(95));
  }
  const double conditioned = seconds();
  const Batch batch = choose_batch(after, ucb(0.5), {}, candidates, {.size = 10});
  const double done = seconds();
  std::printf(
      "%-22s rank %4d  ready %5.2f s  condition %6.1f ms  choose %6.1f ms  (first pick %d, raw "
      "variance %.3f to %.3f)\n",
      name, metric == Metric::Intrinsic ? prior.spectrum().rank() : 0, ready - start,
      1e3 * (conditioned - started), 1e3 * (done - conditioned), batch.vertices.front(),
      variance.minCoeff(), variance.maxCoeff());
}

}  // namespace

int main(int argc, char** argv) {
  const int side = argc > 1 ? std::atoi(argv[1]) : 200;
  if (argc > 2) set_thread_count(std::atoi(argv[2]));
  Random random(3);
  const Surface surface(make_plane({.columns = side, .rows = side, .jitter = 0.2}, random));
  std::printf("%d vertices, %d threads\n", surface.vertex_count(), thread_count());
  measure("ambient", surface, Metric::Ambient, false);
  measure("intrinsic", surface, Metric::Intrinsic, false);
  measure("ambient, learned", surface, Metric::Ambient, true);
  measure("intrinsic, learned", surface, Metric::Intrinsic, true);
}
