// Whether readings fit tissue that moved, or a sensor that changed, while one touched.
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
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
/// best of these is looked at more closely.
constexpr double kMost_m = 0.006, kStep_m = 0.002, kFinest_m = 0.00025;
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
            std::max(std::sqrt(belief.noise_variance()), kLeastNoise * belief.signal_sd())} {
    for (const std::size_t i : in_time(belief.palpations(), kMostReadings)) {
      readings_.push_back(belief.palpations()[i]);
      numbers_.push_back(made_of(belief.palpations(), i).number);
    }
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
  /// How many readings were made before one of these.
  std::size_t number(std::size_t reading) const { return numbers_[reading]; }
  double low() const { return low_; }
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

  /// By the gain of before, where it is so many times as large. Noise is the sensor's own, and does
  /// not change with it: what varies less than noise would is no tissue that stands out less.
  Instead divided_by(double gain) const {
    Instead divided{readings_};
    for (Palpation& one : divided.readings) {
      one.reading = low_ + (one.reading - low_) / gain;
      const double variance =
          std::isnan(one.noise_variance) ? at_.noise_sd * at_.noise_sd : one.noise_variance;
      one.noise_variance = variance / (gain * gain);
    }
    return divided;
  }

  double log_likelihood_unchanged() const {
    return log_likelihood(prior_, gather_sites(prior_, readings_), at_);
  }

  /// Those since the first of them are these instead, each so much denser than what was felt.
  double log_likelihood_since(std::size_t first, const Instead& instead, double log_scale) const {
    try {
      std::vector<Site> sites = gather_sites(prior_, std::span(readings_).first(first));
      for (Site& site : gather_sites(prior_, std::span(instead.readings).subspan(first))) {
        site.place.coordinates += instead.shift;
        sites.push_back(std::move(site));
      }
      return log_likelihood(prior_, sites, at_) +
             log_scale * static_cast<double>(readings_.size() - first);
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
  std::vector<std::size_t> numbers_;
  std::vector<Palpation> readings_;
  double low_ = 0.0;
  Vec3 across_, along_;
  Eigen::Matrix<double, 3, 2> coordinates_;  // of the metric, by each of these
};

/// Log of a reading's density over that of what stands for it without the change.
double log_scale_of(const Misfit& change) {
  return change.kind == MisfitKind::Gain ? -std::log1p(change.amount) : 0.0;
}

/// What those since it were, had it not happened.
Instead without(const ChangedField& field, const Misfit& change) {
  switch (change.kind) {
    case MisfitKind::Moved:
      return field.moved_by(change.moved_m);
    case MisfitKind::Gain:
      return field.divided_by(1.0 + change.amount);
    default:
      return field.lowered_by(change.amount);
  }
}

/// Changes of one kind, each at every moment.
class Changes {
 public:
  explicit Changes(const ChangedField& field)
      : field_(field), unchanged_(field.log_likelihood_unchanged()) {}

  void weigh(Misfit change) {
    const Instead instead = without(field_, change);
    for (std::size_t span = 1; span < kSpans; ++span) {
      const std::size_t first = span * field_.readings().size() / kSpans;
      change.evidence =
          field_.log_likelihood_since(first, instead, log_scale_of(change)) - unchanged_;
      factors_.add(change.evidence);
      if (change.evidence > best_.evidence) best_ = change, first_ = first;
    }
  }

  /// Of the kind.
  double evidence() const { return factors_.value(); }
  /// The strongest, and the first reading that differs.
  const Misfit& best() const { return best_; }
  std::size_t first() const { return first_; }

 private:
  const ChangedField& field_;
  double unchanged_;
  LogMean factors_;
  Misfit best_{.evidence = -std::numeric_limits<double>::infinity()};
  std::size_t first_ = 0;
};

std::vector<Misfit> all_moves(const ChangedField& field) {
  std::vector<Misfit> moves;
  const int steps = static_cast<int>(std::lround(kMost_m / kStep_m));
  for (int i = -steps; i <= steps; ++i) {
    for (int j = -steps; j <= steps; ++j) {
      if (const int square = i * i + j * j; square == 0 || square > steps * steps) continue;
      const Vec3 move_m = field.in_plane(i * kStep_m, j * kStep_m);
      moves.push_back({.kind = MisfitKind::Moved, .amount = move_m.norm(), .moved_m = move_m});
    }
  }
  return moves;
}

/// Uphill, by steps that are halved; and to its first reading, among those that were skipped.
std::pair<Misfit, std::size_t> closer_look(const ChangedField& field, Misfit move,
                                           std::size_t first) {
  const auto value_of = [&](const Vec3& moved_m, std::size_t since) {
    return field.log_likelihood_since(since, field.moved_by(moved_m), 0.0);
  };
  double best = value_of(move.moved_m, first);
  const auto climb = [&] {
    for (double step_m = 0.5 * kStep_m; step_m >= kFinest_m; step_m *= 0.5) {
      const Vec3 centre = move.moved_m;
      for (const auto& [i, j] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        const Vec3 next = centre + field.in_plane(i * step_m, j * step_m);
        const double there = value_of(next, first);
        if (there > best) best = there, move.moved_m = next;
      }
    }
  };
  climb();
  const std::size_t count = field.readings().size(), skipped = count / kSpans, middle = first;
  for (std::size_t since = std::max(middle, skipped + 1) - skipped;
       since <= std::min(middle + skipped, count - 1); ++since) {
    const double there = value_of(move.moved_m, since);
    if (there > best) best = there, first = since;
  }
  climb();
  move.amount = move.moved_m.norm();
  return {move, first};
}

}  // namespace

bool is_background(const Misfit& change) {
  return change.kind == MisfitKind::Tilted || change.kind == MisfitKind::Waves ||
         change.kind == MisfitKind::Drift;
}

bool is_displacement(const Misfit& change) {
  return change.kind == MisfitKind::Moved || change.kind == MisfitKind::Late;
}

bool is_of_all(const Misfit& change) {
  return is_background(change) || change.kind == MisfitKind::Late;
}

bool is_since(const Misfit& change, const Made& made) {
  if (is_of_all(change)) return true;
  if (change.session > 0) return made.session >= change.session;
  return std::pair(made.batch, made.number) >= std::pair(change.from_batch, change.number);
}

std::optional<Misfit> changed_since(const Belief& belief) {
  const ChangedField field(belief);
  if (field.readings().size() < kSpans) return std::nullopt;
  Changes moves(field), zeros(field), gains(field);
  for (const Misfit& one : all_moves(field)) moves.weigh(one);
  for (const double of_signal : kZeros)
    zeros.weigh({.kind = MisfitKind::Zero, .amount = of_signal * field.signal_sd()});
  for (const double gain : kGains)
    gains.weigh({.kind = MisfitKind::Gain, .amount = gain - 1.0, .low = field.low()});
  const Changes& strongest = *std::ranges::max({&moves, &zeros, &gains}, {},
                                               [](const Changes* of) { return of->evidence(); });
  if (!(strongest.evidence() > surprising())) return std::nullopt;
  auto [found, first] = std::pair(strongest.best(), strongest.first());
  if (found.kind == MisfitKind::Moved) std::tie(found, first) = closer_look(field, found, first);
  found.evidence = strongest.evidence();
  found.number = field.number(first);
  found.from_batch = field.readings()[first].batch;
  return found;
}

}  // namespace palpation
