#include "palpation/certainty/misfit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "base/log_mean.h"
#include "certainty/edge_belief_fit.h"
#include "certainty/layout.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kKinds = 4.0;  // zero, gain, place, parts
/// What a rival may add, standard deviations: of the contrast, and of a gain.
constexpr double kPart = 0.5;
/// Radii of parts that are tried; they begin so far outside of the outline.
constexpr std::array kRadii_m = {0.002, 0.004};
constexpr double kApart_m = 0.002;

/// The readings and their most probable explanation under one kind of outline.
struct Explained {
  const Surface& surface;
  const EdgeFit& fit;
  const EdgeData& data;
  double log_weight;  ///< of this kind of outline, against the most likely one's
  double contrast;
  Eigen::VectorXd depth;     ///< of each row
  Eigen::VectorXd share;     ///< of the contrast, at that depth
  Eigen::VectorXd residual;  ///< r
};

/// Rivals of one kind, in turn.
class Kind {
 public:
  /// `column`: h.
  void weigh(const Explained& rows, const Eigen::VectorXd& column, Misfit rival) {
    const double before = rows.residual.dot(rows.fit.pull), b = column.dot(rows.fit.pull);
    const double a = kPart * kPart * column.dot(rows.fit.covariance.solve(column));
    const double after = before - kPart * kPart * b * b / (1.0 + a);
    if (!(after > 0.0)) return factors_.add(-std::numeric_limits<double>::infinity());
    rival.evidence = rows.log_weight +
                     0.5 * static_cast<double>(column.size()) * std::log(before / after) -
                     0.5 * std::log1p(a);
    rival.amount *= kPart * kPart * b / (1.0 + a);
    factors_.add(rival.evidence);
    if (!best_ || rival.evidence > best_->evidence) best_ = rival;
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
  Eigen::VectorXd part(static_cast<Eigen::Index>(data.batches.size()));
  for (std::size_t i = 0; i < data.batches.size(); ++i) {
    const std::vector<int>& made = data.batches[i];
    part[static_cast<Eigen::Index>(i)] =
        static_cast<double>(std::ranges::count_if(made, [&](int one) { return one >= batch; })) /
        static_cast<double>(made.size());
  }
  return part;
}

/// What may have changed from one batch to the next.
void weigh_changes(const Explained& rows, Kind& zero, Kind& gain) {
  std::set<int> batches;
  for (const std::vector<int>& made : rows.data.batches) batches.insert(made.begin(), made.end());
  if (batches.empty()) return;
  batches.erase(batches.begin());
  for (const int batch : batches) {
    const Eigen::VectorXd since = part_since(rows.data, batch);
    zero.weigh(rows, rows.contrast * since,
               {.kind = MisfitKind::Zero, .from_batch = batch, .amount = rows.contrast});
    gain.weigh(rows, rows.contrast * since.cwiseProduct(rows.share),
               {.kind = MisfitKind::Gain, .from_batch = batch, .amount = 1.0});
  }
}

/// A hill around each place outside.
void weigh_parts(const Explained& rows, const Layout& layout, Kind& weaker) {
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
      weaker.weigh(rows, hill,
                   {.kind = MisfitKind::WeakerPart,
                    .amount = rows.contrast,
                    .where = rows.data.places[centre]});
    }
  }
}

}  // namespace

double surprising(double false_alarms) {
  require(false_alarms > 0.0 && false_alarms < 1.0, "misfits",
          "false_alarms = " + text_of(false_alarms), "must lie in (0, 1)");
  return std::log(kKinds / false_alarms);
}

std::vector<Misfit> EdgeBelief::misfits(double false_alarms) const {
  const double least = surprising(false_alarms);
  Kind zero, gain, weaker;
  for (const auto& one : fits_) {
    const EdgeFit& fit = one->edge;
    Explained rows{surface_,
                   fit,
                   one->data,
                   std::log(one->weight / most_likely().weight),
                   profile_.high - profile_.low,
                   one->data.depth_m + fit.correction_m,
                   {},
                   fit.covariance.matrixL() * Eigen::VectorXd(fit.covariance.matrixU() * fit.pull)};
    rows.share =
        rows.depth.unaryExpr([&](double depth) { return profile_share(fit.profile, depth); });
    weigh_changes(rows, zero, gain);
    weigh_parts(rows, Layout(one->correction), weaker);
  }
  std::vector<Misfit> found;
  for (const Kind* kind : {&zero, &gain, &weaker}) {
    const std::optional<Misfit> verdict = kind->verdict();
    if (verdict && verdict->evidence > least) found.push_back(*verdict);
  }
  if (std::ranges::find(found, MisfitKind::WeakerPart, &Misfit::kind) == found.end())
    found.insert(found.end(), weaker_.begin(), weaker_.end());
  std::ranges::sort(found, std::greater{}, &Misfit::evidence);
  return found;
}

}  // namespace palpation
