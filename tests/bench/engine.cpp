// What each step of planning costs on a jittered plane: to build a belief, to grow it by ten
// readings, to choose ten places, to ask once. Never part of ctest. Arguments of each: vertices
// along a side, readings known.
//
//   cmake --build build/release --target bench_engine && taskset -c 1
//   build/release/bin/bench_engine --benchmark_filter='Update'

#include <benchmark/benchmark.h>

#include <map>
#include <numeric>
#include <utility>

#include "bench/tissue.h"
#include "palpation/base/parallel.h"
#include "palpation/decision/batch.h"

using namespace palpation;

namespace {

constexpr int kBatch = 10;

const Scene& scene(int side) {
  static std::map<int, Scene> scenes;
  const auto found = scenes.find(side);
  return found != scenes.end() ? found->second : scenes.emplace(side, Scene(side)).first->second;
}

std::span<const Palpation> first(const Scene& tissue, int count) {
  return std::span(tissue.readings).first(static_cast<std::size_t>(count));
}

void Build(benchmark::State& state) {
  const Scene& tissue = scene(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    const Belief belief =
        tissue.blank.condition_on(first(tissue, static_cast<int>(state.range(1))));
    benchmark::DoNotOptimize(&belief);
  }
}

void Update(benchmark::State& state) {
  const Scene& tissue = scene(static_cast<int>(state.range(0)));
  const int count = static_cast<int>(state.range(1));
  Belief before = tissue.blank.condition_on(first(tissue, 5));
  for (int known = 5; known + kBatch < count; known += kBatch) {
    before =
        before.condition_on(first(tissue, known + kBatch).subspan(static_cast<std::size_t>(known)));
  }
  const auto more = first(tissue, count).subspan(before.palpations().size());
  for (auto _ : state) {
    const Belief belief = before.condition_on(more);
    benchmark::DoNotOptimize(&belief);
  }
}

void Marginals_(benchmark::State& state) {
  const Scene& tissue = scene(static_cast<int>(state.range(0)));
  const Belief belief = tissue.blank.condition_on(first(tissue, static_cast<int>(state.range(1))));
  for (auto _ : state) benchmark::DoNotOptimize(belief.at_vertices().mean.data());
}

void Choose(benchmark::State& state, Evaluation evaluation) {
  const Scene& tissue = scene(static_cast<int>(state.range(0)));
  const Belief belief = tissue.blank.condition_on(first(tissue, static_cast<int>(state.range(1))));
  Batch batch;
  for (auto _ : state) {
    batch = choose_batch(belief, ils_ucb(0.5), kLevel, tissue.everywhere,
                         {.size = kBatch, .evaluation = evaluation});
  }
  state.counters["evaluated"] = static_cast<double>(batch.evaluations) /
                                (kBatch * static_cast<double>(tissue.everywhere.size()));
}

void At(benchmark::State& state) {
  const Scene& tissue = scene(static_cast<int>(state.range(0)));
  const Belief belief = tissue.blank.condition_on(first(tissue, static_cast<int>(state.range(1))));
  std::vector<SurfacePoint> points;
  for (int vertex = 0; vertex < tissue.surface.vertex_count(); vertex += 40)
    points.push_back(tissue.surface.at_vertex(vertex));
  for (auto _ : state) benchmark::DoNotOptimize(belief.at(points).mean.data());
}

BENCHMARK(Build)->Args({200, 105})->Args({200, 205})->Unit(benchmark::kMillisecond)->MinTime(0.5);
BENCHMARK(Update)->Args({200, 105})->Args({200, 205})->Unit(benchmark::kMillisecond)->MinTime(0.5);
BENCHMARK(Marginals_)->Args({200, 205})->Unit(benchmark::kMillisecond)->MinTime(0.2);
BENCHMARK_CAPTURE(Choose, lazy, Evaluation::Lazy)
    ->Args({200, 105})
    ->Args({200, 205})
    ->Unit(benchmark::kMillisecond)
    ->MinTime(0.3);
BENCHMARK_CAPTURE(Choose, exhaustive, Evaluation::Exhaustive)
    ->Args({200, 205})
    ->Unit(benchmark::kMillisecond)
    ->MinTime(0.1);
BENCHMARK(At)->Args({200, 205})->Unit(benchmark::kMillisecond)->MinTime(0.1);

}  // namespace

int main(int argc, char** argv) {
  set_thread_count(1);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
