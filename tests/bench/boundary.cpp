// What each step after a belief costs, from the level set on: loops and area, Booleans, the edge's
// own belief, a tour; and, before it, to learn hyperparameters, a surface, a chart. Never part of
// ctest. Arguments: vertices along a side, or corners, or readings, or stops.
//
//   cmake --build build/release --target bench_boundary && taskset -c 1
//   build/release/bin/bench_boundary --benchmark_repetitions=5

#include <benchmark/benchmark.h>

#include <numbers>

#include "bench/tissue.h"
#include "palpation/base/parallel.h"
#include "palpation/belief/hyperparameters.h"
#include "palpation/boundary/level_set.h"
#include "palpation/boundary/region_error.h"
#include "palpation/certainty/edge_belief.h"
#include "palpation/decision/tour.h"
#include "palpation/geometry/make_phantom.h"

using namespace palpation;

namespace {

const Scene& scene() {
  static const Scene one(200);
  return one;
}

Belief belief_of(int readings) {
  return scene().blank.condition_on(
      std::span(scene().readings).first(static_cast<std::size_t>(readings)));
}

void LoopsAndArea(benchmark::State& state) {
  const Field mean = belief_of(205).at_vertices().mean;
  for (auto _ : state) {
    const std::vector<LevelLoop> loops = level_loops(scene().surface, mean, kLevel.value);
    benchmark::DoNotOptimize(loops.data());
    benchmark::DoNotOptimize(superlevel_area(scene().surface, mean, kLevel.value));
  }
}

void LevelSetRegion(benchmark::State& state) {
  const Field mean = belief_of(205).at_vertices().mean;
  for (auto _ : state)
    benchmark::DoNotOptimize(superlevel_region(scene().surface, mean, kLevel.value).area());
}

/// A disk with a wave around its rim, about as wide as a tumour.
Region rippled_disk(int corners, double x_m) {
  PolygonWithHoles disk;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners,
                 radius_m = 0.00625 + 0.0002 * std::sin(9.0 * angle);
    disk.outer.emplace_back(x_m + radius_m * std::cos(angle), 0.030 + radius_m * std::sin(angle));
  }
  return Region(std::span(&disk, 1));
}

void SymmetricDifference(benchmark::State& state) {
  const int corners = static_cast<int>(state.range(0));
  const Region a = rippled_disk(corners, 0.0115), b = rippled_disk(corners, 0.0117);
  for (auto _ : state) benchmark::DoNotOptimize(symmetric_difference(a, b).area());
}

void OverlapAreasOnly(benchmark::State& state) {
  const int corners = static_cast<int>(state.range(0));
  const Region a = rippled_disk(corners, 0.0115), b = rippled_disk(corners, 0.0117);
  for (auto _ : state) benchmark::DoNotOptimize(overlap_areas(a, b).both_m2);
}

void Learn(benchmark::State& state) {
  const auto readings = std::span(scene().readings).first(static_cast<std::size_t>(state.range(0)));
  const Prior& prior = scene().blank.prior();
  const Hyperparameters before = learn(prior, readings.first(readings.size() - 10), {}, {}).values;
  for (auto _ : state) benchmark::DoNotOptimize(learn(prior, readings, before, {}).values.length_m);
}

void Edge(benchmark::State& state) {
  const Belief belief = belief_of(static_cast<int>(state.range(0)));
  const Marginals marginals = belief.at_vertices();
  const double first_levels[] = {kLevel.value};
  for (auto _ : state)
    benchmark::DoNotOptimize(
        EdgeBelief::around(belief, marginals, first_levels, 0.5, {}, 0.0)->level().value);
}

void Tour(benchmark::State& state) {
  const auto stops = static_cast<Eigen::Index>(state.range(0));
  Random random(3);
  Eigen::MatrixXd places(2, stops + 1), distance(stops + 1, stops + 1);
  for (double& coordinate : places.reshaped()) coordinate = random.uniform();
  for (Eigen::Index i = 0; i <= stops; ++i)
    distance.col(i) = (places.colwise() - places.col(i)).colwise().norm().transpose();
  for (auto _ : state) benchmark::DoNotOptimize(shortest_tour(distance).data());
}

void MakeSurface(benchmark::State& state) {
  const TriangleMesh mesh = Scene::plane(static_cast<int>(state.range(0))).mesh();
  for (auto _ : state) benchmark::DoNotOptimize(Surface(mesh).area());
}

void ChartOfADome(benchmark::State& state) {
  Random random(3);
  const TriangleMesh mesh =
      make_phantom(dome_sheet(), static_cast<double>(state.range(0)) * 1e-6, 0.2, random).mesh;
  for (auto _ : state) benchmark::DoNotOptimize(Surface(mesh).chart().uv.data());
}

BENCHMARK(LoopsAndArea)->Unit(benchmark::kMillisecond);
BENCHMARK(LevelSetRegion)->Unit(benchmark::kMillisecond);
BENCHMARK(SymmetricDifference)->Arg(500)->Arg(5000)->Unit(benchmark::kMillisecond);
BENCHMARK(OverlapAreasOnly)->Arg(500)->Arg(5000)->Unit(benchmark::kMillisecond);
BENCHMARK(Learn)->Arg(105)->Arg(205)->Unit(benchmark::kMillisecond);
BENCHMARK(Edge)->Arg(105)->Arg(205)->Unit(benchmark::kMillisecond);
BENCHMARK(Tour)->Arg(10)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK(MakeSurface)->Arg(200)->Unit(benchmark::kMillisecond);
BENCHMARK(ChartOfADome)->ArgName("edge_um")->Arg(500)->Arg(250)->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  set_thread_count(1);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
