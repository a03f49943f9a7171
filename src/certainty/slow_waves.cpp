#include "certainty/slow_waves.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "certainty/few_terms.h"

namespace palpation {
namespace {

constexpr double kLeftOut = 1e-3;  ///< of the waves' variance at any place, at most
constexpr int kTogether = 1000;    ///< vertices, whose covariances are held at once

/// The place nearest to the middle of all: the first pivot.
Eigen::Index middle_of(const Surface& surface, std::span<const SurfacePoint> places) {
  Vec3 middle = Vec3::Zero();
  for (const SurfacePoint& place : places)
    middle += surface.position(place) / static_cast<double>(places.size());
  return std::ranges::min_element(places, {},
                                  [&](const SurfacePoint& place) {
                                    return (surface.position(place) - middle).squaredNorm();
                                  }) -
         places.begin();
}

}  // namespace

SlowWaves::SlowWaves(Surface surface, Metric metric, double length_m,
                     std::span<const SurfacePoint> places)
    : prior_(std::move(surface), metric,
             Kernel{.family = KernelFamily::Matern52, .length_m = length_m}, Constant{.sd = 0.0}) {
  const auto alike = [&](Eigen::Index pivot) -> Eigen::VectorXd {
    return prior_.covariance(places, places.subspan(static_cast<std::size_t>(pivot), 1));
  };
  FewTerms few =
      few_terms(Eigen::VectorXd::Ones(std::ssize(places)), alike,
                {.left_out = kLeftOut, .first_pivot = middle_of(prior_.surface(), places)});
  terms_ = std::move(few.terms);
  for (const Eigen::Index pivot : few.pivots)
    pivots_.push_back(places[static_cast<std::size_t>(pivot)]);
  of_pivots_ = terms_(few.pivots, Eigen::all);
}

Field SlowWaves::at_vertices(const Eigen::VectorXd& coefficients) const {
  const Surface& surface = prior_.surface();
  const Eigen::VectorXd weights =
      of_pivots_.transpose().triangularView<Eigen::Upper>().solve(coefficients);
  Field waves(surface.vertex_count());
  for (int first = 0; first < surface.vertex_count(); first += kTogether) {
    std::vector<SurfacePoint> vertices;
    for (int vertex = first; vertex < std::min(first + kTogether, surface.vertex_count()); ++vertex)
      vertices.push_back(surface.at_vertex(vertex));
    waves.segment(first, std::ssize(vertices)) = prior_.covariance(vertices, pivots_) * weights;
  }
  return waves;
}

}  // namespace palpation
