#include "readings/outliers.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "readings/robust.h"

namespace palpation {
namespace {

constexpr std::size_t kAround = 20;
constexpr std::size_t kListed = 40;  // neighbours, of whom some may be set aside
constexpr double kSure = 5.0;        // standard deviations
constexpr double kSameWay = 0.9;     // cosine: within 25 degrees, where a lag moves both alike
constexpr double kLeastNoise =
    0.03;                       // of the field's standard deviation: no model of an edge is better
constexpr double kShown = 6.0;  // noises between the least and the greatest reading: the others
                                // show a contrast of their own
constexpr double kMostShare = 0.1;         // of the readings
constexpr std::size_t kLeastReadings = 5;  // fewer cannot say which of them is wrong
constexpr double kLength_m = 0.0035;       // of the field that they are held against

/// Of a rough field at two places so far apart: Matern 3/2.
double correlation(const Vec3& difference) {
  const double s = std::sqrt(3.0 * (difference / kLength_m).squaredNorm());
  return (1.0 + s) * std::exp(-s);
}

bool comparable(const Palpation& a, const Palpation& b) {
  const bool a_travels = !a.travel.isZero(0.0), b_travels = !b.travel.isZero(0.0);
  return a_travels == b_travels && (!a_travels || a.travel.dot(b.travel) > kSameWay);
}

class Neighbourhoods {
 public:
  Neighbourhoods(const std::vector<Palpation>& palpations, const std::vector<Vec3>& places)
      : palpations_(palpations), places_(places) {
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

  /// How many standard deviations a reading is from what those around it predict: kriging with an
  /// unknown mean.
  double deviation(std::size_t i) const {
    const std::vector<std::size_t> around = left_around(i, kAround);
    const auto n = static_cast<Eigen::Index>(around.size());
    const double signal = signal_without(palpations_[i].reading);
    if (n < 2 || signal == 0.0) return 0.0;
    const double noise = std::max(noise_, kLeastNoise * signal),
                 noise_ratio = noise * noise / (signal * signal);
    Eigen::MatrixXd k(n, n);
    Eigen::MatrixXd right_sides(n, 3);  // correlations with the place, ones, readings
    for (Eigen::Index a = 0; a < n; ++a) {
      const std::size_t here = around[a];
      for (Eigen::Index b = 0; b < n; ++b) {
        k(a, b) = correlation(places_[here] - places_[around[b]]);
      }
      k(a, a) += noise_ratio;
      right_sides.row(a) << correlation(places_[i] - places_[here]), 1.0,
          palpations_[here].reading - palpations_[i].reading;
    }
    const Eigen::MatrixXd solved = k.llt().solve(right_sides);
    const double precision = solved.col(1).sum();
    const double mean = solved.col(2).sum() / precision;
    const double residual_one = 1.0 - solved.col(0).sum();
    const double predicted = right_sides.col(0).dot(solved.col(2)) + residual_one * mean;
    const double variance = 1.0 + noise_ratio - right_sides.col(0).dot(solved.col(0)) +
                            residual_one * residual_one / precision;
    return std::abs(predicted) / (signal * std::sqrt(variance));
  }

 private:
  double range(std::size_t from_least, std::size_t from_greatest) const {
    return sorted_.size() < 2 ? 0.0
                              : sorted_[sorted_.size() - 1 - from_greatest] - sorted_[from_least];
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
      if (other == i || !comparable(palpations_[i], palpations_[other])) continue;
      others.emplace_back((places_[other] - places_[i]).squaredNorm(), other);
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
  std::vector<std::size_t> used_;
  std::vector<bool> out_;
  std::vector<std::vector<std::size_t>> around_;
  std::vector<double> sorted_;
  double noise_ = 0.0;
};

}  // namespace

std::vector<std::size_t> outliers(const std::vector<Palpation>& palpations,
                                  const std::vector<Vec3>& places) {
  Neighbourhoods field(palpations, places);
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
