// Whether readings fit tissue that moved, or a sensor that changed, while one touched.
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/log_mean.h"
#include "belief/likelihood.h"
#include "palpation/base/error.h"
#include "palpation/certainty/misfit.h"
#include "readings/readings.h"
#include "readings/robust.h"

namespace palpation {
namespace {

/// How far tissue may have moved, and how finely that is tried: a field's length is 3.5 mm. The
/// best of these is looked at more closely, to be told.
constexpr double kMost_m = 0.006, kStep_m = 0.002, kFinest_m = 0.0005;
/// What a zero may have moved by, of the field's standard deviation: half of a contrast is one.
constexpr std::array kZeros = {-2.0, -1.5, -1.0, -0.5, -0.25, 0.25, 0.5, 1.0, 1.5, 2.0};
/// What a gain may have changed to; and the part of the readings below which healthy ones lie, that
/// it leaves alone.
constexpr std::array kGains = {0.5, 0.7, 0.85, 1.2, 1.4, 2.0};
constexpr double kLow = 0.1;
/// Noise is taken to be no less, of the field's standard deviation: a smooth field does not follow
/// an edge more closely, and what it misses there is no change.
constexpr double kLeastNoise = 0.1;
/// The likelihood costs the third power of their number.
constexpr std::size_t kMostReadings = 200;
/// Moments are tried that part the readings into so many of equal number.
constexpr std::size_t kSpans = 12;

std::vector<Palpation> telling(std::span<const Palpation> palpations) {
  std::vector<Palpation> some;
  for (const std::size_t i : in_time(palpations, kMostReadings)) some.push_back(palpations[i]);
  return some;
}

/// Readings in place of others, at places so far off in the metric's coordinates.
struct Instead {
  std::vector<Palpation> readings;
  Vec3 shift = Vec3::Zero();
};

/// How probable the readings are if those since one of them were made otherwise.
class ChangedField {
 public:
  explicit ChangedField(const Belief& belief)
      : prior_(belief.prior()),
        at_{prior_.kernel().length_m, belief.signal_sd(),
            std::max(std::sqrt(belief.noise_variance()), kLeastNoise * belief.signal_sd())},
        readings_(telling(belief.palpations())) {
    Vec3 normal = Vec3::Zero();
    std::vector<double> values;
    for (const Palpation& one : readings_) {
      normal += prior_.surface().normal(one.where);
      values.push_back(one.reading);
    }
    if (!values.empty()) low_ = quantile(values, kLow);
    across_ = normal.unitOrthogonal();
    along_ = normal.normalized().cross(across_);
    if (!readings_.empty() && prior_.surface().is_planar()) coordinates_ = metric_in_plane();
  }

  const std::vector<Palpation>& readings() const { return readings_; }
  double signal_sd() const { return at_.signal_sd; }

  /// In the tissue's plane.
  Vec3 in_plane(double across_m, double along_m) const {
    return across_m * across_ + along_m * along_;
  }

  /// At the places of the tissue at rest, where each was made after it moved. On planar tissue
  /// these are as far off in the metric's coordinates, border or not.
  Instead moved_by(const Vec3& move_m) const {
    if (prior_.surface().is_planar())
      return {readings_, -(coordinates_ * Vec2(move_m.dot(across_), move_m.dot(along_)))};
    Instead moved{readings_};
    for (Palpation& one : moved.readings)
      one.where = prior_.surface().project(prior_.surface().position(one.where) - move_m);
    return moved;
  }

  /// By the zero of before, where it has risen by so much.
  Instead lowered_by(double zero) const {
    Instead lowered{readings_};
    for (Palpation& one : lowered.readings) one.reading -= zero;
    return lowered;
  }

  /// By the gain of before, where it is so many times as large.
  Instead divided_by(double gain) const {
    Instead divided{readings_};
    for (Palpation& one : divided.readings) one.reading = low_ + (one.reading - low_) / gain;
    return divided;
  }

  double log_likelihood_unchanged() const {
    return log_likelihood(prior_, gather_sites(prior_, readings_), at_);
  }

  /// Those since the first of them are these instead.
  double log_likelihood_of(std::size_t first, const Instead& instead) const {
    try {
      std::vector<Site> sites = gather_sites(prior_, std::span(readings_).first(first));
      for (Site& site : gather_sites(prior_, std::span(instead.readings).subspan(first))) {
        site.place.coordinates += instead.shift;
        sites.push_back(std::move(site));
      }
      return log_likelihood(prior_, sites, at_);
    } catch (const Error&) {
      return -std::numeric_limits<double>::infinity();  // places brought together that the noise
                                                        // does not part
    }
  }

 private:
  /// Planar tissue lies in the metric's coordinates as in space, turned.
  Eigen::Matrix<double, 3, 2> metric_in_plane() const {
    const auto count = static_cast<Eigen::Index>(readings_.size());
    Eigen::MatrixX2d plane(count, 2);
    Eigen::MatrixX3d metric(count, 3);
    for (Eigen::Index i = 0; i < count; ++i) {
      const SurfacePoint& where = readings_[static_cast<std::size_t>(i)].where;
      const Vec3 position = prior_.surface().position(where);
      plane.row(i) << position.dot(across_), position.dot(along_);
      metric.row(i) = prior_.place(where).coordinates;
    }
    plane.rowwise() -= Eigen::RowVector2d(plane.colwise().mean());
    metric.rowwise() -= Eigen::RowVector3d(metric.colwise().mean());
    return plane.completeOrthogonalDecomposition().solve(metric).transpose();
  }

  const Prior& prior_;
  Hyperparameters at_;
  std::vector<Palpation> readings_;
  double low_ = 0.0;
  Vec3 across_, along_;
  Eigen::Matrix<double, 3, 2> coordinates_;  // of the metric, by each of these
};

/// Changes of one kind, each at every moment.
class Changes {
 public:
  explicit Changes(const ChangedField& field)
      : field_(field), unchanged_(field.log_likelihood_unchanged()) {}

  /// `log_scale`: log of a reading's density over that of what stands for it.
  void weigh(const Instead& instead, Misfit change, double log_scale = 0.0) {
    for (std::size_t span = 1; span < kSpans; ++span) {
      const std::size_t first = span * field_.readings().size() / kSpans;
      change.evidence = field_.log_likelihood_of(first, instead) - unchanged_ +
                        log_scale * static_cast<double>(instead.readings.size() - first);
      factors_.add(change.evidence);
      if (!(change.evidence > best_.evidence)) continue;
      change.from_batch = field_.readings()[first].batch;
      best_ = change;
      first_ = first;
    }
  }

  /// The strongest, with the kind's evidence.
  Misfit verdict() const {
    Misfit misfit = best_;
    misfit.evidence = factors_.value();
    return misfit;
  }

  /// Of the strongest.
  std::size_t first() const { return first_; }

 private:
  const ChangedField& field_;
  double unchanged_;
  LogMean factors_;
  Misfit best_{.evidence = -std::numeric_limits<double>::infinity()};
  std::size_t first_ = 0;
};

Changes moves_of(const ChangedField& field) {
  Changes moved(field);
  const int steps = static_cast<int>(std::lround(kMost_m / kStep_m));
  for (int i = -steps; i <= steps; ++i) {
    for (int j = -steps; j <= steps; ++j) {
      if (const int square = i * i + j * j; square == 0 || square > steps * steps) continue;
      const Vec3 move_m = field.in_plane(i * kStep_m, j * kStep_m);
      moved.weigh(field.moved_by(move_m), {.kind = MisfitKind::Moved, .moved_m = move_m});
    }
  }
  return moved;
}

/// Uphill by steps that are halved.
Vec3 closer_look(const ChangedField& field, std::size_t first, Vec3 move_m) {
  double best = field.log_likelihood_of(first, field.moved_by(move_m));
  for (double step_m = 0.5 * kStep_m; step_m >= kFinest_m; step_m *= 0.5) {
    const Vec3 centre = move_m;
    for (const auto& [i, j] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const Vec3 next = centre + field.in_plane(i * step_m, j * step_m);
      const double there = field.log_likelihood_of(first, field.moved_by(next));
      if (there > best) best = there, move_m = next;
    }
  }
  return move_m;
}

}  // namespace

std::optional<Misfit> changed_since(const Belief& belief) {
  const ChangedField field(belief);
  if (field.readings().size() < kSpans) return std::nullopt;
  const Changes moved = moves_of(field);
  Changes zeros(field);
  for (const double of_signal : kZeros) {
    const double zero = of_signal * field.signal_sd();
    zeros.weigh(field.lowered_by(zero), {.kind = MisfitKind::Zero, .amount = zero});
  }
  Changes gains(field);
  for (const double gain : kGains)
    gains.weigh(field.divided_by(gain), {.kind = MisfitKind::Gain, .amount = gain - 1.0},
                -std::log(gain));
  Misfit found =
      std::ranges::max({moved.verdict(), zeros.verdict(), gains.verdict()}, {}, &Misfit::evidence);
  if (!(found.evidence > surprising())) return std::nullopt;
  if (found.kind == MisfitKind::Moved) {
    found.moved_m = closer_look(field, moved.first(), found.moved_m);
    found.amount = found.moved_m.norm();
  }
  return found;
}

}  // namespace palpation
