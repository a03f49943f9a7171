#include "certainty/doubts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/normal.h"
#include "boundary/erosion.h"
#include "certainty/band_width.h"
#include "certainty/layout.h"

namespace palpation {
namespace {

constexpr double kFar_m = 0.008;
/// As likely as not, on its side.
constexpr double kLeastScore = 1e-9;

/// One more standard deviation, `more`, beside `sd`, which the score was divided by.
Certainty doubted(Certainty certainty, const Surface& surface, const Field& sd, const Field& more) {
  const double before = certainty.half_width_m;
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    if (sd[vertex] > 0.0)
      certainty.score[vertex] *= sd[vertex] / std::hypot(sd[vertex], more[vertex]);
  }
  certainty.half_width_m = mean_half_width(surface, certainty.score, certainty.band_score);
  if (before == 0.0) return certainty;
  certainty.expected.missed_m2 *= certainty.half_width_m / before;
  certainty.expected.extra_m2 *= certainty.half_width_m / before;
  return certainty;
}

}  // namespace

Certainty less_tip(Certainty certainty, const Surface& surface, double radius_m) {
  const double felt = boundary_length(surface, certainty.score);
  certainty.score = eroded(surface, certainty.score, radius_m).field;
  certainty.half_width_m = mean_half_width(surface, certainty.score, certainty.band_score);
  if (felt == 0.0) return certainty;
  const double share = boundary_length(surface, certainty.score) / felt;
  certainty.expected.missed_m2 *= share;
  certainty.expected.extra_m2 *= share;
  return certainty;
}

Certainty without_part(Certainty certainty, const Surface& surface, std::span<const int> vertices,
                       double score) {
  const double before = boundary_length(surface, certainty.score);
  double area_m2 = 0.0;
  for (const int vertex : vertices) {
    certainty.score[vertex] = std::min(certainty.score[vertex], score);
    area_m2 += surface.vertex_areas()[vertex];
  }
  certainty.half_width_m = mean_half_width(surface, certainty.score, certainty.band_score);
  const double share = before > 0.0 ? boundary_length(surface, certainty.score) / before : 1.0;
  certainty.expected.extra_m2 *= share;
  certainty.expected.missed_m2 =
      share * certainty.expected.missed_m2 + normal_probability(score) * area_m2;
  return certainty;
}

Certainty with_doubtful_part(Certainty certainty, const Belief& belief,
                             std::span<const int> vertices, double edge_sd_m) {
  const Surface& surface = belief.prior().surface();
  const Layout layout(belief.prior());
  std::vector<Vec3> part;
  for (const int vertex : vertices) {
    part.push_back(layout.at(vertex));
    certainty.expected.missed_m2 += 0.5 * surface.vertex_areas()[vertex];
  }
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    if (certainty.score[vertex] >= 0.0) continue;
    const Vec3 place = layout.at(vertex);
    double square = std::numeric_limits<double>::infinity();
    for (const Vec3& other : part) square = std::min(square, (other - place).squaredNorm());
    certainty.score[vertex] =
        std::max(certainty.score[vertex], -std::max(std::sqrt(square) / edge_sd_m, kLeastScore));
  }
  certainty.half_width_m = mean_half_width(surface, certainty.score, certainty.band_score);
  return certainty;
}

Certainty as_likely_another(Certainty certainty, const Surface& surface,
                            const std::optional<Field>& other_score) {
  double missed_m2 = 0.0, extra_m2 = 0.0;
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    double& score = certainty.score[vertex];
    const bool is_inside = score >= 0.0;
    const double other = other_score ? (*other_score)[vertex] : -std::abs(score),
                 area_m2 = surface.vertex_areas()[vertex],
                 inside_other = other_score ? normal_probability(other) : 0.0;
    (is_inside ? extra_m2 : missed_m2) += area_m2 * (is_inside ? 1.0 - inside_other : inside_other);
    const double sureness =
        is_inside == (other >= 0.0) ? std::min(std::abs(score), std::abs(other)) : kLeastScore;
    score = is_inside ? sureness : -sureness;
  }
  certainty.half_width_m = mean_half_width(surface, certainty.score, certainty.band_score);
  certainty.expected.missed_m2 = 0.5 * (certainty.expected.missed_m2 + missed_m2);
  certainty.expected.extra_m2 = 0.5 * (certainty.expected.extra_m2 + extra_m2);
  return certainty;
}

Certainty doubted_where_contact_fades(Certainty certainty, const Surface& surface,
                                      const FadingContact& fading, const Field& sd,
                                      double whole_loss) {
  const Eigen::VectorXd along = surface.mesh().vertices * fading.towards;
  const double start = along.minCoeff(), length = along.maxCoeff() - start;
  const double farthest = fading.base_fall * whole_loss;
  const Field here = sd.array().max(1e-12 * farthest);
  return doubted(std::move(certainty), surface, here, farthest * (along.array() - start) / length);
}

Certainty doubted_as_a_whole(Certainty certainty, const Surface& surface, const Field& offset_sd_m,
                             double place_sd_m) {
  return doubted(std::move(certainty), surface, offset_sd_m,
                 Field::Constant(surface.vertex_count(), place_sd_m));
}

Certainty doubted_where_untouched(Certainty certainty, const Belief& belief,
                                  const Marginals& marginals, const Level& level) {
  const Surface& surface = belief.prior().surface();
  const Layout layout(belief.prior());
  const std::vector<Vec3> touched = layout.touched(belief.palpations());
  const double level_sd = level.stddev.value_or(0.0);
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    const Vec3 place = layout.at(vertex);
    const auto is_near = [&](const Vec3& other) {
      return (other - place).squaredNorm() < kFar_m * kFar_m;
    };
    if (std::any_of(touched.begin(), touched.end(), is_near)) continue;
    const double sd = std::sqrt(marginals.variance[vertex] + level_sd * level_sd);
    const double sureness = std::min(std::abs(certainty.score[vertex]),
                                     std::abs(marginals.mean[vertex] - level.value) / sd);
    const bool inside = certainty.score[vertex] >= 0.0;
    certainty.score[vertex] = inside ? sureness : -sureness;
    const double here = surface.vertex_areas()[vertex];
    certainty.untouched_m2 += here;
    certainty.untouched_error_m2 += here * normal_probability(-sureness);
  }
  return certainty;
}

}  // namespace palpation
