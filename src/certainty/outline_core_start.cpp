#include "certainty/outline_core_start.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "certainty/outline_core_odds.h"
#include "certainty/outline_lines.h"
#include "certainty/outline_pruning.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

/// Contrasts beside a core that are tried, of its own.
constexpr std::array kBeside = {0.45, 0.55, 0.65, 0.75};

/// Of one part.
OutlineNodes part_of(const OutlineNodes& outline, int part) {
  OutlineNodes alone;
  for (const NodeLoop& loop : outline.loops)
    if (loop.part == part) alone.add(line_of(outline, loop), 0);
  return alone;
}

bool overlap(const OutlineNodes& some, const OutlineNodes& others) {
  const auto holds_a_node = [](const OutlineNodes& outline, const OutlineNodes& nodes) {
    return std::ranges::any_of(nodes.place,
                               [&](const Vec2& node) { return is_inside(outline, node); });
  };
  return holds_a_node(some, others) || holds_a_node(others, some);
}

/// About places, each of which stands for as much area: as far from their middle on average.
OutlineCore core_about(const std::vector<Vec2>& places, double beside) {
  Vec2 middle = Vec2::Zero();
  const auto count = static_cast<double>(places.size());
  for (const Vec2& place : places) middle += place / count;
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const Vec2& place : places)
    spread += (place - middle) * (place - middle).transpose() / count;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread);
  // A disk's variance along an axis is a quarter of its radius' square, an even line's a third.
  const double radius = std::max(2.0 * std::sqrt(std::max(axes.eigenvalues()[0], 0.0)), kSpacing_m),
               length = 2.0 * std::sqrt(std::max(axes.eigenvalues()[1], 0.0));
  const Vec2 along = axes.eigenvectors().col(1);
  return {.middle = middle,
          .log_radius = std::log(radius),
          .half_length_m = std::max(length - radius, 0.0),
          .angle = std::atan2(along.y(), along.x()),
          .beside = beside};
}

/// Half way up to what lies beside a core, where the field is highest; elsewhere the parts as they
/// were.
std::optional<OutlineStart> start_with(const OutlineStart& plain, const Surface& surface,
                                       const Field& mean, double beside) {
  // The edge may take what rises up to its middle for part of something higher.
  const double low = plain.profile.low, range = std::min(plain.profile.high, mean.maxCoeff()) - low;
  if (!(range > 0.0)) return std::nullopt;
  const OutlineNodes halfway = outline_from(
      lines_of(surface, mean.array() - (low + 0.5 * beside * range)), plain.readings.places);
  const auto place_of = [&](int vertex) -> Vec2 {
    return surface.chart().uv.row(vertex).transpose();
  };
  OutlineNodes part;
  std::vector<Vec2> in_core;
  for (int i = 0; i < halfway.parts(); ++i) {
    const OutlineNodes one = part_of(halfway, i);
    std::vector<Vec2> within;
    for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
      if (mean[vertex] > low + 0.5 * (1.0 + beside) * range && is_inside(one, place_of(vertex)))
        within.push_back(place_of(vertex));
    }
    if (within.size() <= in_core.size()) continue;
    part = one;
    in_core = std::move(within);
  }
  if (in_core.empty()) return std::nullopt;
  OutlineNodes outline = part;
  for (int i = 0; i < plain.outline.parts(); ++i) {
    const OutlineNodes other = part_of(plain.outline, i);
    if (overlap(part, other)) continue;
    const int number = outline.parts();
    for (const NodeLoop& loop : other.loops) outline.add(line_of(other, loop), number);
  }
  if (!is_simple(outline)) return std::nullopt;
  OutlineStart start = plain;
  begin_with(outline, start);
  start.profile.core = core_about(in_core, beside);
  start.profile.high = low + range;
  return start;
}

struct Cored {
  OutlineStart start;
  SettledOutline walk;
};

/// Outlines that have settled: of one height, or with a core that is none if that is more probable;
/// and those with a core, the most probable first.
struct SettledOutlines {
  SettledOutline plain;
  std::vector<Cored> cored{};
};

/// As they begin the most probable would be the one that is nearest to one of one height.
SettledOutlines settled_outlines(const OutlineStart& plain, const Surface& surface,
                                 const Field& mean, std::uint64_t seed) {
  std::vector<OutlineStart> starts = {plain};
  for (const double beside : kBeside) {
    if (beside < least_beside(plain.prior.fraction)) continue;
    if (std::optional<OutlineStart> cored = start_with(plain, surface, mean, beside))
      starts.push_back(*std::move(cored));
  }
  std::vector<SettledOutline> walks(starts.size());
  for_ranges(static_cast<int>(starts.size()), 1, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      if (i > 0) starts[i] = pruned(std::move(starts[i]), seed);
      walks[i] = settled(starts[i], seed);
    }
  });
  SettledOutlines all{.plain = walks.front()};
  for (std::size_t i = 1; i < starts.size(); ++i) {
    if (walks[i].is_level())
      all.plain.log_odds = std::max(all.plain.log_odds, walks[i].log_odds);
    else if (starts[i].profile.core)
      all.cored.push_back({std::move(starts[i]), std::move(walks[i])});
  }
  std::ranges::sort(all.cored, std::greater{}, [&](const Cored& one) {
    return one.walk.log_odds + alike(all.plain, one.walk);
  });
  return all;
}

}  // namespace

ChainStarts with_core_if_paid(const OutlineStart& plain, const Surface& surface, const Field& mean,
                              std::uint64_t seed) {
  const SettledOutlines all = settled_outlines(plain, surface, mean, seed);
  // What surely is of two is taken before what may be, which may begin elsewhere.
  for (const Cored& one : all.cored) {
    if (heights_by(all.plain, one.walk) == Heights::Two)
      return {.of = {one.start, one.start}, .least_area_m2 = area_between(all.plain, one.walk)};
  }
  for (const Cored& one : all.cored) {
    if (heights_by(all.plain, one.walk) == Heights::OneOrTwo)
      return {.of = {plain, one.start},
              .least_area_m2 = area_between(all.plain, one.walk),
              .probability = probability_of_two(all.plain, one.walk)};
  }
  return {.of = {plain, plain}};
}

}  // namespace palpation
