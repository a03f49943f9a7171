#include "geometry/start_block.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "palpation/base/parallel.h"
#include "palpation/base/random.h"
#include "palpation/base/types.h"

namespace palpation {
namespace {

constexpr double kLeastVariety =
    1e-5;  // of features that measure about 1, among neighbours: less is a regular mesh
constexpr double kAlike = 1e-6;  // traits that differ by less are the same
constexpr double kTurns =
    0.5;  // of a wave for a step in one trait as large as usual among neighbours

std::size_t rows_of(const ShiftedLaplacian& laplacian) {
  return static_cast<std::size_t>(laplacian.mass.cols());
}

/// c (G + c M)^-1 M: a mean over the neighbourhood.
Strip spread(const ShiftedLaplacian& laplacian, const Strip& in) {
  Strip out;
  multiply(laplacian.mass, in, out);
  laplacian.factor.solve(out);
  for (double& value : out) value *= laplacian.shift;
  return out;
}

/// Sixteen functions of a vertex' own weight in G and its area.
Strip features(const ShiftedLaplacian& laplacian) {
  const Eigen::VectorXd weights = laplacian.stiffness.diagonal();
  const Eigen::VectorXd areas = laplacian.mass * Eigen::VectorXd::Ones(laplacian.mass.cols());
  const double mean = areas.mean();
  Random random(1);
  std::array<Vec3, kStrip> waves;
  for (Vec3& wave : waves)
    wave = Vec3(3.0 * random.normal(), 3.0 * random.normal(), 6.0 * random.uniform());
  Strip made(rows_of(laplacian) * kStrip);
  for (Eigen::Index row = 0; row < areas.size(); ++row) {
    const Vec3 traits(std::log(std::max(weights[row], 1e-9)),
                      std::log(std::max(areas[row] / mean, 1e-9)), 1.0);
    for (int lane = 0; lane < kStrip; ++lane)
      made[row * kStrip + lane] = std::cos(waves[lane].dot(traits));
  }
  return made;
}

/// Whether two vertices have the same traits.
bool has_twins(const Strip& traits) {
  const std::size_t count = traits.size() / kStrip;
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return traits[a * kStrip] < traits[b * kStrip]; });
  const auto are_alike = [&](std::size_t a, std::size_t b) {
    return std::equal(traits.begin() + static_cast<std::ptrdiff_t>(a * kStrip),
                      traits.begin() + static_cast<std::ptrdiff_t>((a + 1) * kStrip),
                      traits.begin() + static_cast<std::ptrdiff_t>(b * kStrip),
                      [](double x, double y) { return std::abs(x - y) < kAlike; });
  };
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1;
         j < count && traits[order[j] * kStrip] - traits[order[i] * kStrip] < kAlike; ++j) {
      if (are_alike(order[i], order[j])) return true;
    }
  }
  return false;
}

/// Sixteen traits of each vertex that follow from what is around it, and differ among neighbours by
/// about 1; nothing where they do not tell all vertices apart.
std::optional<Strip> traits_of(const ShiftedLaplacian& laplacian) {
  Strip traits = spread(laplacian, features(laplacian));
  const Strip mean = spread(laplacian, traits);
  Strip square(traits.size());
  for (std::size_t i = 0; i < traits.size(); ++i) {
    traits[i] -= mean[i];
    square[i] = traits[i] * traits[i];
  }
  const Strip variance = spread(laplacian, square);
  for (std::size_t row = 0; row < rows_of(laplacian); ++row) {
    double sum = 0.0;
    for (int lane = 0; lane < kStrip; ++lane) sum += variance[row * kStrip + lane] / kStrip;
    if (!(sum > kLeastVariety)) return std::nullopt;
    for (int lane = 0; lane < kStrip; ++lane) traits[row * kStrip + lane] /= std::sqrt(sum);
  }
  if (has_twins(traits)) return std::nullopt;
  return traits;
}

/// From 1 at whole numbers straight down to -1 between them.
double triangle_wave(double turns) {
  constexpr double kWhole = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to whole numbers
  const double part = turns - ((turns + kWhole) - kWhole);
  return 1.0 - 4.0 * std::abs(part);
}

Strip waves_of(const Strip& traits, const Eigen::VectorXd& scale, Random& random) {
  std::array<std::array<double, kStrip>, kStrip> slopes;  // by trait
  std::array<double, kStrip> phases;
  for (auto& of_trait : slopes) {
    for (double& slope : of_trait) slope = kTurns * random.normal();
  }
  for (double& phase : phases) phase = random.uniform();
  Strip strip(traits.size());
  for (Eigen::Index row = 0; row < scale.size(); ++row) {
    const double* here = traits.data() + row * kStrip;
    std::array<double, kStrip> turns = phases;
    for (int trait = 0; trait < kStrip; ++trait) {
      for (int lane = 0; lane < kStrip; ++lane) turns[lane] += here[trait] * slopes[trait][lane];
    }
    for (int lane = 0; lane < kStrip; ++lane)
      strip[row * kStrip + lane] = scale[row] * triangle_wave(turns[lane]);
  }
  return strip;
}

Strip signs(const Eigen::VectorXd& scale, Random& random) {
  Strip strip(static_cast<std::size_t>(scale.size()) * kStrip);
  for (Eigen::Index row = 0; row < scale.size(); ++row) {
    std::uint64_t bits = random.bits();
    for (int lane = 0; lane < kStrip; ++lane, bits >>= 1)
      strip[row * kStrip + lane] = (bits & 1) ? scale[row] : -scale[row];
  }
  return strip;
}

}  // namespace

std::vector<Strip> start_block(const ShiftedLaplacian& laplacian, int strips) {
  const Eigen::VectorXd scale = laplacian.mass.diagonal().cwiseSqrt().cwiseInverse();
  const std::optional<Strip> traits = traits_of(laplacian);
  std::vector<Strip> block(static_cast<std::size_t>(strips));
  Random random(1);
  if (!traits) {
    for (Strip& strip : block) strip = signs(scale, random);
    return block;
  }
  std::vector<Random> streams;
  for (int i = 0; i < strips; ++i) streams.emplace_back(random.bits());
  for_ranges(strips, 1, [&](int first, int last) {
    for (int i = first; i < last; ++i) block[i] = waves_of(*traits, scale, streams[i]);
  });
  return block;
}

}  // namespace palpation
