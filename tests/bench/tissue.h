/// The tissue that the benchmarks ask about: a jittered plane of 25 x 50 mm with one round tumour,
/// and a robot's noisy readings on it.
#pragma once

#include <cmath>
#include <numeric>
#include <vector>

#include "palpation/base/random.h"
#include "palpation/belief/belief.h"
#include "palpation/belief/level.h"
#include "palpation/geometry/make_plane.h"

namespace palpation {

inline constexpr double kLength_m = 0.0033;
inline constexpr double kNoiseSd = 0.01;
inline const Level kLevel{0.5, 0.0};

struct Scene {
  explicit Scene(int side, int reading_count = 205)
      : surface(plane(side)),
        blank(Prior(surface, Metric::Chart, {.length_m = kLength_m}, {.sd = 0.0}),
              {.noise_sd = kNoiseSd}) {
    Random random(7);
    noise.resize(static_cast<std::size_t>(surface.vertex_count()));
    for (double& one : noise) one = kNoiseSd * random.normal();
    std::vector<bool> is_touched(noise.size(), false);
    while (static_cast<int>(touched.size()) < reading_count) {
      const int vertex = random.below(surface.vertex_count());
      if (is_touched[vertex]) continue;
      is_touched[vertex] = true;
      touched.push_back(vertex);
      readings.push_back({.where = surface.at_vertex(vertex), .reading = reading(vertex)});
    }
    everywhere.resize(static_cast<std::size_t>(surface.vertex_count()));
    std::iota(everywhere.begin(), everywhere.end(), 0);
  }

  static Surface plane(int side) {
    Random random(3);
    return Surface(make_plane({.columns = side, .rows = side, .jitter = 0.2}, random));
  }

  /// 0 on healthy tissue, 1 on the tumour, and noise.
  double reading(int vertex) const {
    const double distance_m = (surface.vertex(vertex) - Vec3(0.0115, 0.030, 0.0)).norm();
    return 1.0 / (1.0 + std::exp(1400.0 * (distance_m - 0.00625))) + noise[vertex];
  }

  Surface surface;
  Belief blank;
  std::vector<double> noise;  // of a reading at each vertex
  std::vector<int> touched;
  std::vector<Palpation> readings;
  std::vector<int> everywhere;
};

}  // namespace palpation
