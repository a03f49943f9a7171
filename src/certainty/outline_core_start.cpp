#include "certainty/outline_core_start.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>

#include "base/sigmoid.h"
#include "certainty/outline_core_odds.h"
#include "certainty/outline_lines.h"
#include "certainty/outline_pruning.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

/// Contrasts beside a core that are tried, of its own.
constexpr std::array kBeside = {0.45, 0.55, 0.65, 0.75};
/// How far beyond three quarters of the way up a core reaches that ends with the outline, in steps
/// of a sigmoid: one to half way up, and two to where its own edge is over.
constexpr double kBeyond = 3.0;

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

/// Where the field is highest: the part of the outlines there, and the vertices that reach half of
/// the way from beside a core up to it.
struct Highest {
  OutlineNodes part{};
  std::vector<Vec2> in_core{};
};
Highest highest_of(const OutlineNodes& outlines, const Surface& surface, const Field& mean,
                   double least) {
  Highest highest;
  for (int i = 0; i < outlines.parts(); ++i) {
    OutlineNodes part = part_of(outlines, i);
    std::vector<Vec2> in_core;
    for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
      const Vec2 place = surface.chart().uv.row(vertex).transpose();
      if (mean[vertex] > least && is_inside(part, place)) in_core.push_back(place);
    }
    if (in_core.size() > highest.in_core.size()) highest = {std::move(part), std::move(in_core)};
  }
  return highest;
}

/// About the part that has a core, and elsewhere as it was; nothing where lines would cross.
std::optional<OutlineStart> start_about(const OutlineNodes& part, const OutlineCore& core,
                                        double high, const OutlineStart& plain) {
  OutlineNodes outline = part;
  for (int i = 0; i < plain.outline.parts(); ++i) {
    const OutlineNodes other = part_of(plain.outline, i);
    if (overlap(part, other)) continue;
    const int number = outline.parts();
    for (const NodeLoop& loop : other.loops) outline.add(line_of(other, loop), number);
  }
  if (part.loops.empty() || !is_simple(outline)) return std::nullopt;
  OutlineStart start = plain;
  begin_with(outline, start);
  start.profile.core = core;
  start.profile.high = high;
  return start;
}

/// Outlines half way up to what they enclose, where some of it stands out by `beside` of the rest.
/// A core within, around which tissue is softer on all sides, begins half way up from that; of two
/// that lie side by side the stiffer one is a core that reaches beyond the outline.
std::vector<OutlineStart> starts_with(const OutlineStart& plain, const Surface& surface,
                                      const Field& mean, double beside) {
  // The edge may take what rises up to its middle for part of something higher.
  const double low = plain.profile.low, range = std::min(plain.profile.high, mean.maxCoeff()) - low;
  std::vector<OutlineStart> starts;
  if (!(range > 0.0)) return starts;
  const auto outlines_at = [&](const Field& height) {
    return outline_from(lines_of(surface, height), plain.readings.places);
  };
  const auto add = [&](const OutlineNodes& part, const OutlineCore& core) {
    if (std::optional<OutlineStart> start = start_about(part, core, low + range, plain))
      starts.push_back(*std::move(start));
  };
  const double up = 0.5 * (1.0 + beside), slope_per_m = std::exp(plain.profile.log_slope);
  const auto [part, in_core] = highest_of(outlines_at(mean.array() - (low + 0.5 * beside * range)),
                                          surface, mean, low + up * range);
  if (in_core.empty()) return starts;
  OutlineCore core = core_about(in_core, beside);
  add(part, core);
  core.log_radius = std::log(std::exp(core.log_radius) + kBeyond / slope_per_m);
  const Stadium places = core.stadium();
  Field above(mean.size());
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    const double depth_m = places.depth_at(surface.chart().uv.row(vertex).transpose()),
                 height = beside + (1.0 - beside) * sigmoid(slope_per_m * depth_m);
    above[vertex] = mean[vertex] - low - 0.5 * height * range;
  }
  add(highest_of(outlines_at(above), surface, mean, low + up * range).part, core);
  return starts;
}

struct Cored {
  OutlineStart start;
  SettledOutline walk;
};

/// Outlines that have settled: of one height, or with a core that is none if that is more probable;
/// and those with a core, the most probable first: how alike readings are beside it speaks against
/// one height, not for one core over another.
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
    std::ranges::move(starts_with(plain, surface, mean, beside), std::back_inserter(starts));
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
  std::ranges::sort(all.cored, std::greater{}, [](const Cored& one) { return one.walk.log_odds; });
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
