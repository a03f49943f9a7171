#include "certainty/outline_core_start.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include "certainty/outline_lines.h"
#include "certainty/outline_pruning.h"
#include "certainty/outline_walk.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

/// Contrasts beside a core that are tried, of its own.
constexpr std::array kBeside = {0.45, 0.55, 0.65, 0.75};
constexpr double kFalseAlarms = 0.02;
constexpr double kLevel = 0.9;  ///< of the way up: it levels off
constexpr double kSeldom = 0.05;
constexpr int kNumbers = 6;                    ///< that are a core's
constexpr int kSettling = 150, kWeighed = 50;  ///< sweeps

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

/// Of a walk that has settled, on average.
struct Settled {
  double evidence = 0.0;   ///< log density of the readings,
  double price = 0.0;      ///< and what the outline's freedom costs
  double area_m2 = 0.0;    ///< within the outline,
  double square_m4 = 0.0;  ///< and of its square
  double inside = 0.0;     ///< readings in the part that has the core, if one does,
  double alike = 0.0;      ///< and how improbable it is that those on the plateau beside it
                           ///< read alike by chance, nats
  double level = 0.0;      ///< how often what lies beside it is as good as level with it

  double paid() const { return evidence - price; }
  double area_sd_m2() const { return std::sqrt(std::max(square_m4 - area_m2 * area_m2, 0.0)); }
};

void count_inside(const OutlineChain& chain, const OutlineReadings& readings, Settled& sum) {
  const ReadingLaw& law = chain.law();
  const OutlineNodes& outline = chain.outline();
  if (!law.core) return;
  if (law.core->beside > kLevel) sum.level += 1.0 / kWeighed;
  const double noise = std::exp(chain.residuals().log_noise());
  for (std::size_t i = 0; i < readings.places.size(); ++i) {
    const Vec2& place = readings.places[i];
    const double depth = depth_in(outline, place);
    const int nearest = outline.loop_of[nearest_piece(outline, place).piece];
    if (depth < 0.0 || outline.loops[nearest].part != law.core->part) continue;
    sum.inside += 1.0 / kWeighed;
    if (share_at(law, depth, steepness_at(law, place)) < kLevel ||
        share_by_core(law, place) > law.core->beside + (1.0 - kLevel) * (1.0 - law.core->beside))
      continue;
    // Anywhere on the way from there to the core, or as noise scatters about one height.
    const double way = law.contrast[law.core->part] * (1.0 - law.core->beside),
                 scatter =
                     std::sqrt(2.0 * std::numbers::pi * std::numbers::e * readings.variance[i]);
    sum.alike += std::max(std::log(way / (noise * scatter)), 0.0) / kWeighed;
  }
}

Settled settled(const OutlineStart& start, std::uint64_t seed) {
  OutlineWalk walk(start.readings, start.prior, start.outline, start.profile, seed);
  walk.settle(kSettling);
  Settled sum;
  for (int i = 0; i < kWeighed; ++i) {
    walk.settle(1);
    const OutlineChain& chain = walk.chain();
    sum.evidence += chain.residuals().log_density() / kWeighed;
    sum.price += price_of_loops(chain.outline(), start.readings.places.size()) / kWeighed;
    const double area_m2 = enclosed_area(chain.outline());
    sum.area_m2 += area_m2 / kWeighed;
    sum.square_m4 += area_m2 * area_m2 / kWeighed;
    count_inside(chain, start.readings, sum);
  }
  return sum;
}

/// Whether they end elsewhere, by more than both spread.
bool are_apart(const Settled& some, const Settled& others) {
  return std::abs(some.area_m2 - others.area_m2) > some.area_sd_m2() + others.area_sd_m2();
}

enum class Told { Plain, Either, Core };

/// An outline of one height follows such readings as lie on a plateau beside the core by fingers,
/// and could have followed any: that they read alike speaks for the core. Where that is not surely
/// so, tissue may as well rise all the way up to its middle: then readings that pay for a core by
/// themselves tell neither. Nor do those that pay for none, where the two end elsewhere: that an
/// outline of one height has fewer numbers makes a tumour no smaller. Then it is told by readings
/// that speak against a core by more than chance.
Told told_by(const Settled& plain, const Settled& cored) {
  const double chance = -std::log(kFalseAlarms),
               needed = chance + 0.5 * kNumbers * std::log(std::max(cored.inside, 1.0));
  const double gained = cored.paid() - plain.paid();
  if (cored.level < kSeldom && cored.alike > chance && gained + cored.alike > needed)
    return Told::Core;
  const bool is_open = gained > needed || (are_apart(plain, cored) && gained > -chance);
  return is_open ? Told::Either : Told::Plain;
}

struct Cored {
  OutlineStart start;
  Settled walk{};
  Told told = Told::Plain;
};

/// Of those that keep a core when they have settled the one first that readings pay most for: as
/// they begin that would be the one that is nearest to one of one height.
std::vector<Cored> cored_starts(const OutlineStart& plain, const Surface& surface,
                                const Field& mean, std::uint64_t seed) {
  std::vector<Cored> all = {{plain}};
  for (const double beside : kBeside) {
    if (beside < least_beside(plain.prior.fraction)) continue;
    if (std::optional<OutlineStart> start = start_with(plain, surface, mean, beside))
      all.push_back({*std::move(start)});
  }
  for_ranges(static_cast<int>(all.size()), 1, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      if (i > 0) all[i].start = pruned(std::move(all[i].start), seed);
      all[i].walk = settled(all[i].start, seed);
    }
  });
  const Settled of_plain = all.front().walk;
  std::erase_if(all, [](const Cored& one) { return !one.start.profile.core; });
  std::ranges::sort(all, std::greater{}, [](const Cored& one) { return one.walk.paid(); });
  for (Cored& one : all) one.told = told_by(of_plain, one.walk);
  return all;
}

}  // namespace

ChainStarts with_core_if_paid(const OutlineStart& plain, const Surface& surface, const Field& mean,
                              std::uint64_t seed) {
  const std::vector<Cored> all = cored_starts(plain, surface, mean, seed);
  const bool is_level = !all.empty() && all.front().walk.level > 0.5;  // there is no second height
  if (all.empty() || is_level) return {plain, plain};
  if (all.front().told == Told::Core) return {all.front().start, all.front().start};
  const auto open = std::ranges::find_if(
      all, [](Told told) { return told != Told::Plain; }, &Cored::told);
  return {plain, open == all.end() ? plain : open->start};
}

}  // namespace palpation
