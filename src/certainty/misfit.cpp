#include "palpation/certainty/misfit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "base/log_mean.h"
#include "certainty/edge_belief_fit.h"
#include "certainty/layout.h"
#include "certainty/outline_model.h"

namespace palpation {
namespace {

/// What a rival may add, standard deviations: of the contrast, and of a gain; of a move, metres.
constexpr double kPart = 0.5;
/// Ways in which tissue may have moved, over half a turn.
constexpr int kWays = 4;
/// Radii of parts that are tried; they begin so far outside of the outline.
constexpr std::array kRadii_m = {0.002, 0.004};
constexpr double kApart_m = 0.002;

constexpr int kMostHills = 4;  ///< that changes are weighed beside

/// The readings and their most probable explanation under one kind of outline.
struct Explained {
  const Surface& surface;
  const EdgeFit& fit;
  const EdgeData& data;
  double log_weight;  ///< of this kind of outline, against the most likely one's
  double low;
  double contrast;
  Eigen::VectorXd depth;     ///< of each row
  Eigen::VectorXd share;     ///< of the contrast, at that depth
  Eigen::VectorXd residual;  ///< r
  Eigen::VectorXd pull;      ///< C^-1 r
  /// Of what else is known to add to the readings: C^-1 is that of the fit less these times their
  /// transposes.
  std::vector<Eigen::VectorXd> also{};

  Explained(const Surface& on, const EdgeFit& edge, const EdgeData& readings,
            const EdgeProfile& profile, double weight)
      : surface(on),
        fit(edge),
        data(readings),
        log_weight(std::log(weight)),
        low(profile.low),
        contrast(profile.high - profile.low),
        depth(readings.depth_m + edge.correction_m),
        share(depth.unaryExpr([&](double at) { return profile_share(edge.profile, at); })),
        residual(edge.covariance.matrixL() *
                 Eigen::VectorXd(edge.covariance.matrixU() * edge.pull)),
        pull(edge.pull) {}

  /// C^-1 times a column.
  Eigen::VectorXd solve(const Eigen::VectorXd& column) const {
    Eigen::VectorXd solved = fit.covariance.solve(column);
    for (const Eigen::VectorXd& known : also) solved -= known * known.dot(column);
    return solved;
  }

  /// From here on a rival is known to add to the readings (Sherman and Morrison's identity).
  void add(const Eigen::VectorXd& column) {
    const Eigen::VectorXd solved = kPart * solve(column);
    also.push_back(solved / std::sqrt(1.0 + kPart * column.dot(solved)));
    pull -= also.back() * also.back().dot(residual);
  }
};

/// A rival with its evidence and amount. `column`: h.
Misfit weighed(const Explained& rows, const Eigen::VectorXd& column, Misfit rival) {
  const double before = rows.residual.dot(rows.pull), b = column.dot(rows.pull);
  const double a = kPart * kPart * column.dot(rows.solve(column));
  const double after = before - kPart * kPart * b * b / (1.0 + a);
  rival.evidence = after > 0.0
                       ? rows.log_weight +
                             0.5 * static_cast<double>(column.size()) * std::log(before / after) -
                             0.5 * std::log1p(a)
                       : -std::numeric_limits<double>::infinity();
  rival.amount *= kPart * kPart * b / (1.0 + a);
  return rival;
}

/// Rivals of one kind, in turn.
class Kind {
 public:
  void weigh(const Explained& rows, const Eigen::VectorXd& column, Misfit rival) {
    rival = weighed(rows, column, std::move(rival));
    factors_.add(rival.evidence);
    if (std::isfinite(rival.evidence) && (!best_ || rival.evidence > best_->evidence))
      best_ = rival;
  }

  /// The strongest one's evidence.
  double strongest() const {
    return best_ ? best_->evidence : -std::numeric_limits<double>::infinity();
  }

  /// The strongest, with the kind's evidence; nothing without rivals.
  std::optional<Misfit> verdict() const {
    if (!best_) return std::nullopt;
    Misfit misfit = *best_;
    misfit.evidence = factors_.value();
    return misfit;
  }

 private:
  LogMean factors_;
  std::optional<Misfit> best_;
};

/// Of each row, the part of its readings from that batch on.
Eigen::VectorXd part_since(const EdgeData& data, int batch) {
  Eigen::VectorXd part(static_cast<Eigen::Index>(data.made.size()));
  for (std::size_t i = 0; i < data.made.size(); ++i) {
    const std::vector<Made>& made = data.made[i];
    part[static_cast<Eigen::Index>(i)] =
        static_cast<double>(
            std::ranges::count_if(made, [&](const Made& one) { return one.batch >= batch; })) /
        static_cast<double>(made.size());
  }
  return part;
}

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

/// By how much readings change for a metre that the tissue moves this way.
Eigen::VectorXd by_move(const Explained& rows, const Field& depth, const Vec3& way) {
  Eigen::VectorXd change = -rows.fit.by_depth;
  for (Eigen::Index i = 0; i < change.size(); ++i)
    change[i] *= gradient_at(rows.surface, depth, rows.data.places[i].face).dot(way);
  return change;
}

/// The ways, in the plane that the readings lie in on the whole.
std::vector<Vec3> ways_of(const Explained& rows) {
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
void weigh_changes(const Explained& rows, const Field& depth, Kind& zero, Kind& gain, Kind& moved) {
  std::set<int> batches;
  for (const std::vector<Made>& made : rows.data.made) {
    for (const Made& one : made) batches.insert(one.batch);
  }
  if (batches.empty()) return;
  batches.erase(batches.begin());
  const std::vector<Vec3> ways = ways_of(rows);
  std::vector<Eigen::VectorXd> changes;
  for (const Vec3& way : ways) changes.push_back(by_move(rows, depth, way));
  constexpr double kScale = kMoveSd_m / kPart;
  for (const int batch : batches) {
    const Eigen::VectorXd since = part_since(rows.data, batch);
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

/// A hill around each place outside: calls `use` with its column and the rival.
template <typename Use>
void each_hill(const Explained& rows, const Layout& layout, Use use) {
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
Eigen::VectorXd strongest_hill(const Explained& rows, const Layout& layout, double evidence) {
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
void add_hills(const Layout& layout, const Field& depth, double least, Explained& rows) {
  if (strongest_hill(rows, layout, least).size() == 0) return;
  Kind zero, gain, moved;
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
  Kind zero, gain, moved, weaker;
  for (const auto& one : fits_) {
    Explained rows(surface_, one->edge, one->data, profile_, one->weight / most_likely().weight);
    const Layout layout(one->correction);
    each_hill(rows, layout, [&](const Eigen::VectorXd& hill, const Misfit& rival) {
      weaker.weigh(rows, hill, rival);
    });
    add_hills(layout, one->depth, least, rows);
    weigh_changes(rows, one->depth, zero, gain, moved);
  }
  std::vector<Misfit> found;
  for (const Kind* kind : {&zero, &gain, &moved, &weaker}) {
    const std::optional<Misfit> verdict = kind->verdict();
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

std::optional<Misfit> EdgeBelief::stands_out_most() const {
  const Fit& fit = most_likely();
  const Explained rows(surface_, fit.edge, fit.data, profile_, 1.0);
  std::optional<Misfit> most;
  each_hill(rows, Layout(fit.correction), [&](const Eigen::VectorXd& hill, const Misfit& rival) {
    const Misfit one = weighed(rows, hill, rival);
    if (one.amount > 0.0 && one.evidence > (most ? most->evidence : 0.0)) most = one;
  });
  return most;
}

}  // namespace palpation
