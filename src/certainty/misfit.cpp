#include "palpation/certainty/misfit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "certainty/edge_belief_fit.h"
#include "certainty/layout.h"
#include "certainty/misfit_rival.h"
#include "certainty/outline_model.h"
#include "palpation/belief/lag.h"

namespace palpation {
namespace {

/// Ways in which tissue may have moved, over half a turn.
constexpr int kWays = 4;
/// Radii of parts that are tried; they begin so far outside of the outline.
constexpr std::array kRadii_m = {0.002, 0.004};
constexpr double kApart_m = 0.002;

constexpr int kMostHills = 4;  ///< that changes are weighed beside

/// The first that was made in or after a batch.
std::size_t first_since(const EdgeData& data, int batch) {
  std::size_t first = std::numeric_limits<std::size_t>::max();
  for (const std::vector<Made>& made : data.made) {
    for (const Made& one : made) {
      if (one.batch >= batch) first = std::min(first, one.number);
    }
  }
  return first;
}

/// In its plane, of a field that is linear on each triangle.
Vec3 gradient_at(const Surface& surface, const Field& field, int face) {
  const Eigen::Vector3i corners = surface.triangle(face);
  const Vec3 a = surface.vertex(corners[1]) - surface.vertex(corners[0]),
             b = surface.vertex(corners[2]) - surface.vertex(corners[0]), normal = a.cross(b);
  const double by_a = field[corners[1]] - field[corners[0]],
               by_b = field[corners[2]] - field[corners[0]];
  return (by_a * b.cross(normal) + by_b * normal.cross(a)) / normal.squaredNorm();
}

/// By how much readings change for a metre that each goes this way, `way(row)`, against the tissue.
template <typename Way>
Eigen::VectorXd by_move(const ExplainedReadings& rows, const Field& depth, Way way) {
  Eigen::VectorXd change = -rows.fit.by_depth;
  for (Eigen::Index i = 0; i < change.size(); ++i)
    change[i] *= gradient_at(rows.surface, depth, rows.data.places[i].face).dot(way(i));
  return change;
}

/// The ways, in the plane that the readings lie in on the whole.
std::vector<Vec3> ways_of(const ExplainedReadings& rows) {
  Vec3 normal = Vec3::Zero();
  for (const SurfacePoint& place : rows.data.places) normal += rows.surface.normal(place);
  const Vec3 across = normal.unitOrthogonal(), along = normal.normalized().cross(across);
  std::vector<Vec3> ways;
  for (int i = 0; i < kWays; ++i) {
    const double angle = i * std::numbers::pi / kWays;
    ways.emplace_back(std::cos(angle) * across + std::sin(angle) * along);
  }
  return ways;
}

/// What may have changed from one batch to the next.
void weigh_changes(const ExplainedReadings& rows, const Field& depth, RivalKind& zero,
                   RivalKind& gain, RivalKind& moved) {
  std::set<int> batches;
  for (const std::vector<Made>& made : rows.data.made) {
    for (const Made& one : made) batches.insert(one.batch);
  }
  if (batches.empty()) return;
  batches.erase(batches.begin());
  const std::vector<Vec3> ways = ways_of(rows);
  std::vector<Eigen::VectorXd> changes;
  for (const Vec3& way : ways)
    changes.push_back(by_move(rows, depth, [&](Eigen::Index) { return way; }));
  constexpr double kScale = kMoveSd_m / kPart;
  for (const int batch : batches) {
    const Eigen::VectorXd since = part_since(rows.data, {.from_batch = batch});
    const std::size_t number = first_since(rows.data, batch);
    zero.weigh(
        rows, rows.contrast * since,
        {.kind = MisfitKind::Zero, .from_batch = batch, .number = number, .amount = rows.contrast});
    gain.weigh(rows, rows.contrast * since.cwiseProduct(rows.share),
               {.kind = MisfitKind::Gain,
                .from_batch = batch,
                .number = number,
                .amount = 1.0,
                .low = rows.low});
    for (std::size_t way = 0; way < ways.size(); ++way)
      moved.weigh(rows, kScale * since.cwiseProduct(changes[way]),
                  {.kind = MisfitKind::Moved,
                   .from_batch = batch,
                   .number = number,
                   .amount = kScale,
                   .moved_m = ways[way]});
  }
}

/// Readings that are of where the probe was a little before.
void weigh_lag(const ExplainedReadings& rows, const Field& depth, RivalKind& late) {
  const auto travel = [&](Eigen::Index row) {
    return travel_to(rows.data.made[static_cast<std::size_t>(row)]);
  };
  const double scale = LagPrior{}.sd_m / kPart;
  const Eigen::VectorXd change = scale * by_move(rows, depth, travel);
  if (!change.isZero(0.0)) late.weigh(rows, change, {.kind = MisfitKind::Late, .amount = scale});
}

/// A hill around each place outside: calls `use` with its column and the rival.
template <typename Use>
void each_hill(const ExplainedReadings& rows, const Layout& layout, Use use) {
  const auto count = static_cast<Eigen::Index>(rows.data.places.size());
  std::vector<Vec3> at;
  for (const SurfacePoint& place : rows.data.places) at.push_back(layout.at(place));
  for (Eigen::Index centre = 0; centre < count; ++centre) {
    for (const double radius_m : kRadii_m) {
      if (rows.depth[centre] > -kApart_m - radius_m) continue;
      Eigen::VectorXd hill(count);
      for (Eigen::Index i = 0; i < count; ++i)
        hill[i] = rows.contrast *
                  std::exp(-0.5 * (at[i] - at[centre]).squaredNorm() / (radius_m * radius_m));
      use(hill, Misfit{.kind = MisfitKind::WeakerPart,
                       .amount = rows.contrast,
                       .where = rows.data.places[centre]});
    }
  }
}

/// Of more evidence than that; empty if none is.
Eigen::VectorXd strongest_hill(const ExplainedReadings& rows, const Layout& layout,
                               double evidence) {
  Eigen::VectorXd strongest;
  each_hill(rows, layout, [&](const Eigen::VectorXd& hill, const Misfit& rival) {
    const double of_hill = weighed(rows, hill, rival).evidence;
    if (of_hill <= evidence) return;
    evidence = of_hill;
    strongest = hill;
  });
  return strongest;
}

/// What stands out in one place explains readings that were made there one after the other, as a
/// change would: hills of more evidence than any change has without them, the strongest first.
void add_hills(const Layout& layout, const Field& depth, double least, ExplainedReadings& rows) {
  if (strongest_hill(rows, layout, least).size() == 0) return;
  RivalKind zero, gain, moved;
  weigh_changes(rows, depth, zero, gain, moved);
  least = std::max({least, zero.strongest(), gain.strongest(), moved.strongest()});
  for (int i = 0; i < kMostHills; ++i) {
    const Eigen::VectorXd hill = strongest_hill(rows, layout, least);
    if (hill.size() == 0) return;
    rows.add(hill);
  }
}

}  // namespace

std::vector<Misfit> EdgeBelief::misfits(double false_alarms) const {
  const double least = surprising(false_alarms);
  RivalKind zero, gain, moved, weaker;
  for (const auto& one : fits_) {
    ExplainedReadings rows(surface_, one->edge, one->data, profile_,
                           one->weight / most_likely().weight);
    const Layout layout(one->correction);
    each_hill(rows, layout, [&](const Eigen::VectorXd& hill, const Misfit& rival) {
      weaker.weigh(rows, hill, rival);
    });
    add_hills(layout, one->depth, least, rows);
    weigh_changes(rows, one->depth, zero, gain, moved);
  }
  std::vector<Misfit> found;
  for (const std::optional<Misfit>& verdict :
       {zero.verdict(), gain.verdict(), moved.verdict(), weaker.verdict(), lag()}) {
    if (verdict && verdict->evidence > least) found.push_back(*verdict);
  }
  for (Misfit& one : found) {
    if (one.kind != MisfitKind::Moved) continue;
    one.moved_m *= one.amount;
    one.amount = std::abs(one.amount);
  }
  if (std::ranges::find(found, MisfitKind::WeakerPart, &Misfit::kind) == found.end())
    found.insert(found.end(), weaker_.begin(), weaker_.end());
  std::ranges::sort(found, std::greater{}, &Misfit::evidence);
  return found;
}

std::optional<Misfit> EdgeBelief::lag() const {
  RivalKind late;
  for (const auto& one : fits_) {
    const ExplainedReadings rows(surface_, one->edge, one->data, profile_,
                                 one->weight / most_likely().weight);
    weigh_lag(rows, one->depth, late);
  }
  return late.verdict();
}

std::optional<Misfit> EdgeBelief::stands_out_most() const {
  const Fit& fit = most_likely();
  const ExplainedReadings rows(surface_, fit.edge, fit.data, profile_, 1.0);
  std::optional<Misfit> most;
  each_hill(rows, Layout(fit.correction), [&](const Eigen::VectorXd& hill, const Misfit& rival) {
    const Misfit one = weighed(rows, hill, rival);
    if (one.amount > 0.0 && one.evidence > (most ? most->evidence : 0.0)) most = one;
  });
  return most;
}

}  // namespace palpation
