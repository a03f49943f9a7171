#include "readings/outliers.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "readings/robust.h"

namespace palpation {
namespace {

constexpr std::size_t kAround = 20;
constexpr std::size_t kListed = 40;  // neighbours, of whom some may be set aside
constexpr double kSure = 5.0;        // standard deviations
constexpr double kLag = 0.43;  // of the length: 1.5 mm of 3.5, by which a probe may feel late or
                               // early (LagPrior)
constexpr double kLeastNoise =
    0.03;                       // of the field's standard deviation: no model of an edge is better
constexpr double kShown = 6.0;  // noises between the least and the greatest reading: the others
                                // show a contrast of their own
constexpr double kMostShare = 0.1;         // of the readings
constexpr std::size_t kLeastReadings = 5;  // fewer cannot say which of them is wrong
constexpr std::size_t kWitnesses = 2;      // a value that none of so many nearest readings nears
                                           // is felt once
constexpr int kCorner = 10;  // one in so many of a sharp corner's neighbours lies within it, too
constexpr int kTurns = 100;
constexpr double kTurn = 0.1;
constexpr double kNear = 0.57;  // of the length, 2 mm of 3.5: no tumour's tip ends so near; as
                                // many contradict what was felt once

/// Of a rough field at two places so many lengths apart: Matern 3/2.
double correlation(double distance2) {
  const double s = std::sqrt(3.0 * distance2);
  return (1.0 + s) * std::exp(-s);
}

/// Whether a sphere of radius 1 through the origin leaves all of these places outside: as far as
/// one turns from the direction of most of them to that of those it holds.
bool are_parted_from_origin(const std::vector<Vec3>& places) {
  Vec3 outward = Vec3::Zero();
  for (const Vec3& place : places) outward += place.normalized();
  for (int turn = 0; turn < kTurns; ++turn) {
    outward.normalize();
    const auto deepest = std::ranges::min_element(
        places, {}, [&](const Vec3& place) { return outward.dot(place) / place.squaredNorm(); });
    if (deepest == places.end() || outward.dot(*deepest) > -0.5 * deepest->squaredNorm())
      return true;
    outward += kTurn * deepest->normalized();
  }
  return false;
}

class Neighbourhoods {
 public:
  Neighbourhoods(const std::vector<Palpation>& palpations, const std::vector<Vec3>& places,
                 double length_m)
      : palpations_(palpations), places_(places), length_m_(length_m) {
    for (std::size_t i = 0; i < palpations.size(); ++i) {
      if (palpations[i].set_aside.empty()) used_.push_back(i);
    }
    out_.assign(palpations.size(), false);
    around_.resize(palpations.size());
    for (std::size_t i : used_) around_[i] = nearest(i);
    restate_scales();
  }

  const std::vector<std::size_t>& used() const { return used_; }
  bool is_out(std::size_t i) const { return out_[i]; }
  void take_out(std::size_t i) { out_[i] = true; }

  /// The range of all that is left, and the noise by which a reading and its nearest one differ.
  void restate_scales() {
    std::vector<double> left, differences;
    for (std::size_t i : used_) {
      if (out_[i]) continue;
      left.push_back(palpations_[i].reading);
      const std::vector<std::size_t> around = left_around(i, 1);
      if (!around.empty())
        differences.push_back(
            std::abs(palpations_[i].reading - palpations_[around.front()].reading));
    }
    std::sort(left.begin(), left.end());
    sorted_ = std::move(left);
    confirmed_range_ = confirmed_range();
    noise_ =
        differences.empty() ? 0.5 * range(0, 0) : 1.4826 * median(differences) / std::sqrt(2.0);
  }

  std::vector<std::size_t> left_around(std::size_t i, std::size_t most) const {
    std::vector<std::size_t> left;
    for (std::size_t other : around_[i]) {
      if (left.size() < most && !out_[other]) left.push_back(other);
    }
    return left;
  }

  /// How many standard deviations a reading is from what those around it predict. Two wild
  /// readings would hide behind each other: where others are near enough to contradict it, what
  /// was felt but once is no scale.
  double deviation(std::size_t i) const {
    const double by_all = deviation(i, signal_without(palpations_[i].reading));
    return is_among_others(i) ? std::max(by_all, deviation(i, 0.5 * confirmed_range_)) : by_all;
  }

 private:
  /// By a field of this standard deviation: kriging with an unknown mean.
  double deviation(std::size_t i, double signal) const {
    const std::vector<std::size_t> around = left_around(i, kAround);
    const auto n = static_cast<Eigen::Index>(around.size());
    if (n < 2 || !(signal > 0.0)) return 0.0;
    const double noise = std::max(noise_, kLeastNoise * signal),
                 noise_ratio = noise * noise / (signal * signal);
    Eigen::MatrixXd k(n, n);
    Eigen::MatrixXd right_sides(n, 3);  // correlations with the place, ones, readings
    for (Eigen::Index a = 0; a < n; ++a) {
      const std::size_t here = around[a];
      for (Eigen::Index b = 0; b < n; ++b) {
        k(a, b) = correlation(distance2(here, around[b]));
      }
      k(a, a) += noise_ratio;
      right_sides.row(a) << correlation(distance2(i, here)), 1.0,
          palpations_[here].reading - palpations_[i].reading;
    }
    const Eigen::MatrixXd solved = k.llt().solve(right_sides);
    const double precision = solved.col(1).sum();
    const double mean = solved.col(2).sum() / precision;
    const double residual_one = 1.0 - solved.col(0).sum();
    const double predicted = right_sides.col(0).dot(solved.col(2)) + residual_one * mean;
    const double variance = 1.0 + noise_ratio - right_sides.col(0).dot(solved.col(0)) +
                            residual_one * residual_one / precision;
    if (is_felt_beside(i, around, predicted)) return 0.0;
    return std::abs(predicted) / (signal * std::sqrt(variance));
  }

  /// Whether places within a length read more like this one than like what is predicted of it,
  /// `from_here` away, and are enough, or an edge as curved as anything that is felt could part it
  /// from all others there: a steep edge is no fault.
  bool is_felt_beside(std::size_t i, const std::vector<std::size_t>& around,
                      double from_here) const {
    int alike = 0;
    std::vector<Vec3> to_unlike;
    for (const std::size_t other : around) {
      if (distance2(i, other) >= 1.0) continue;
      const double difference = palpations_[other].reading - palpations_[i].reading;
      if ((from_here > 0.0 ? difference : -difference) < 0.5 * std::abs(from_here))
        ++alike;
      else
        to_unlike.push_back((places_[other] - places_[i]) / length_m_);
    }
    return (kCorner - 1) * alike > static_cast<int>(to_unlike.size()) ||
           (alike > 0 && are_parted_from_origin(to_unlike));
  }

  /// In lengths, squared, between what is felt: what was read on the way in different directions
  /// may be of places that a lag sets apart.
  double distance2(std::size_t i, std::size_t j) const {
    const double between = ((places_[i] - places_[j]) / length_m_).squaredNorm();
    const bool at_rest =
        palpations_[i].kind == TouchKind::Stop && palpations_[j].kind == TouchKind::Stop;
    if (at_rest) return between;
    return between + kLag * kLag * (palpations_[i].travel - palpations_[j].travel).squaredNorm();
  }

  double range(std::size_t from_least, std::size_t from_greatest) const {
    return sorted_.size() < 2 ? 0.0
                              : sorted_[sorted_.size() - 1 - from_greatest] - sorted_[from_least];
  }

  /// Between the least and the greatest value that one of the nearest readings reaches, too.
  double confirmed_range() const {
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    for (std::size_t i : used_) {
      if (out_[i]) continue;
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (std::size_t other : left_around(i, kWitnesses)) {
        low = std::min(low, palpations_[other].reading);
        high = std::max(high, palpations_[other].reading);
      }
      least = std::min(least, std::max(low, palpations_[i].reading));
      greatest = std::max(greatest, std::min(high, palpations_[i].reading));
    }
    return std::max(greatest - least, 0.0);
  }

  bool is_among_others(std::size_t i) const {
    const std::vector<std::size_t> around = left_around(i, kWitnesses);
    return around.size() == kWitnesses &&
           (places_[around.back()] - places_[i]).norm() < kNear * length_m_;
  }

  /// Half the range of the readings, without this one where the others show contrast: one that is
  /// far off would hide behind itself.
  double signal_without(double reading) const {
    if (sorted_.empty()) return 0.0;
    const double others = range(reading == sorted_.front(), reading == sorted_.back());
    return 0.5 * (others > kShown * noise_ ? others : range(0, 0));
  }

  std::vector<std::size_t> nearest(std::size_t i) const {
    std::vector<std::pair<double, std::size_t>> others;
    for (std::size_t other : used_) {
      if (other != i) others.emplace_back(distance2(i, other), other);
    }
    const std::size_t count = std::min(kListed, others.size());
    std::partial_sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(count),
                      others.end());
    std::vector<std::size_t> numbers;
    for (std::size_t rank = 0; rank < count; ++rank) numbers.push_back(others[rank].second);
    return numbers;
  }

  const std::vector<Palpation>& palpations_;
  const std::vector<Vec3>& places_;
  double length_m_;
  std::vector<std::size_t> used_;
  std::vector<bool> out_;
  std::vector<std::vector<std::size_t>> around_;
  std::vector<double> sorted_;
  double noise_ = 0.0;
  double confirmed_range_ = 0.0;
};

}  // namespace

std::vector<std::size_t> outliers(const std::vector<Palpation>& palpations,
                                  const std::vector<Vec3>& places, double length_m) {
  Neighbourhoods field(palpations, places, length_m);
  const std::vector<std::size_t>& used = field.used();
  if (used.size() < kLeastReadings) return {};
  std::vector<std::size_t> found;
  std::vector<double> deviation(palpations.size(), 0.0);
  for (bool is_new = true; is_new;) {
    is_new = false;
    for (std::size_t i : used) deviation[i] = field.is_out(i) ? 0.0 : field.deviation(i);
    for (std::size_t i : used) {
      if (deviation[i] <= kSure) continue;
      const std::vector<std::size_t> around = field.left_around(i, kAround);
      const bool is_worst = std::all_of(around.begin(), around.end(), [&](std::size_t other) {
        return deviation[other] <= deviation[i];
      });
      if (!is_worst) continue;
      field.take_out(i);
      deviation[i] = 0.0;
      found.push_back(i);
      is_new = true;
    }
    if (static_cast<double>(found.size()) > kMostShare * static_cast<double>(used.size()))
      return {};
    field.restate_scales();
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace palpation
