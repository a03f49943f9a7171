#include "exploration/zero_changes.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "palpation/certainty/misfit.h"

namespace palpation {
namespace {

/// Readings that are looked at: a step shows in as many, and the cost grows with the third power.
constexpr std::size_t kMost = 200;
constexpr std::size_t kFewest = 12;
/// Sensors are fastened anew so often.
constexpr std::size_t kMostChanges = 4;
/// Of the constant that all readings share, of the field's standard deviation: it is not known.
constexpr double kConstant = 30.0;
constexpr double kFalseAlarms = 0.02;

/// Numbers of those that count, as they were made: a batch after the other.
std::vector<std::size_t> in_time(std::span<const Palpation> palpations) {
  std::vector<std::size_t> used, some;
  for (std::size_t i = 0; i < palpations.size(); ++i) {
    if (counts(palpations[i])) used.push_back(i);
  }
  std::ranges::stable_sort(used, {}, [&](std::size_t i) { return palpations[i].batch; });
  const std::size_t stride = used.size() / kMost + 1;
  for (std::size_t i = 0; i < used.size(); i += stride) some.push_back(used[i]);
  return some;
}

bool is_since(const ZeroChange& change, const Palpation& palpation, std::size_t number) {
  return palpation.batch > change.batch ||
         (palpation.batch == change.batch && number >= change.number);
}

/// Steps in readings of a field with a constant that is not known.
class Steps {
 public:
  Steps(const Belief& belief, std::span<const Palpation> palpations,
        std::span<const std::size_t> numbers)
      : palpations_(palpations), numbers_(numbers), variance_(square(belief.signal_sd())) {
    std::vector<SurfacePoint> places;
    for (const std::size_t i : numbers) places.push_back(palpations[i].where);
    const auto count = static_cast<Eigen::Index>(numbers.size());
    Kernel kernel = belief.prior().kernel();
    kernel.signal_sd = belief.signal_sd();
    Eigen::MatrixXd covariance = belief.prior().with(kernel).covariance(places, places);
    covariance.array() += square(kConstant) * variance_;
    readings_.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Palpation& one = palpations[numbers[static_cast<std::size_t>(i)]];
      readings_[i] = one.reading;
      covariance(i, i) +=
          std::isnan(one.noise_variance) ? belief.noise_variance() : one.noise_variance;
    }
    readings_.array() -= readings_.mean();
    inverse_ = covariance.llt().solve(Eigen::MatrixXd::Identity(count, count));
  }

  /// What each of the changes adds, all at once.
  std::vector<ZeroChange> estimated(std::vector<ZeroChange> changes) const {
    if (changes.empty()) return changes;
    const Eigen::MatrixXd steps = columns(changes);
    const Eigen::MatrixXd precision = precision_of(steps);
    const Eigen::MatrixXd covariance =
        precision.llt().solve(Eigen::MatrixXd::Identity(precision.rows(), precision.cols()));
    const Eigen::VectorXd amounts = covariance * (steps.transpose() * (inverse_ * readings_));
    for (std::size_t i = 0; i < changes.size(); ++i) {
      changes[i].amount = amounts[static_cast<Eigen::Index>(i)];
      changes[i].stddev =
          std::sqrt(covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)));
    }
    return changes;
  }

  /// One more than these, where it surprises.
  std::optional<ZeroChange> another(const std::vector<ZeroChange>& known) const {
    Eigen::MatrixXd inverse = inverse_;
    if (!known.empty()) {
      const Eigen::MatrixXd steps = columns(known), weighed = inverse_ * steps;
      inverse -= weighed * precision_of(steps).llt().solve(weighed.transpose());
    }
    const Eigen::VectorXd pull = inverse * readings_;
    const double before = readings_.dot(pull);
    const auto count = readings_.size();
    double sum_a = 0.0, sum_b = 0.0, best = -std::numeric_limits<double>::infinity();
    std::vector<double> evidence;
    Eigen::Index first = 0;
    for (Eigen::Index i = count - 1; i > 0; --i) {
      sum_a += inverse(i, i) + 2.0 * inverse.col(i).tail(count - 1 - i).sum();
      sum_b += pull[i];
      const double after = before - square(sum_b) / (sum_a + 1.0 / variance_);
      evidence.push_back(0.5 * static_cast<double>(count) * std::log(before / after) -
                         0.5 * std::log1p(sum_a * variance_));
      if (evidence.back() > best) best = evidence.back(), first = i;
    }
    double others = 0.0;
    for (const double one : evidence) others += std::exp(one - best);
    const double mean = best + std::log(others / static_cast<double>(evidence.size()));
    if (!(mean > std::log(kMisfitKinds / kFalseAlarms))) return std::nullopt;
    const std::size_t number = numbers_[static_cast<std::size_t>(first)];
    return ZeroChange{.batch = palpations_[number].batch, .number = number};
  }

 private:
  static double square(double value) { return value * value; }

  Eigen::MatrixXd columns(const std::vector<ZeroChange>& changes) const {
    Eigen::MatrixXd steps(readings_.size(), static_cast<Eigen::Index>(changes.size()));
    for (Eigen::Index i = 0; i < steps.rows(); ++i) {
      const std::size_t number = numbers_[static_cast<std::size_t>(i)];
      for (Eigen::Index j = 0; j < steps.cols(); ++j)
        steps(i, j) = is_since(changes[static_cast<std::size_t>(j)], palpations_[number], number);
    }
    return steps;
  }

  Eigen::MatrixXd precision_of(const Eigen::MatrixXd& steps) const {
    Eigen::MatrixXd precision = steps.transpose() * inverse_ * steps;
    precision.diagonal().array() += 1.0 / variance_;
    return precision;
  }

  std::span<const Palpation> palpations_;
  std::span<const std::size_t> numbers_;
  double variance_;  // of a step
  Eigen::VectorXd readings_;
  Eigen::MatrixXd inverse_;
};

bool is_of_the_zero(const Belief& belief) {
  const std::optional<Misfit> change = changed_since(belief);
  return change && change->kind == MisfitKind::Zero;
}

}  // namespace

std::vector<Palpation> with_zeros_taken_back(std::vector<Palpation> palpations,
                                             std::span<const ZeroChange> changes) {
  for (std::size_t i = 0; i < palpations.size(); ++i) {
    for (const ZeroChange& change : changes) {
      if (is_since(change, palpations[i], i)) palpations[i].reading -= change.amount;
    }
  }
  return palpations;
}

std::vector<ZeroChange> zero_changes(std::span<const Palpation> palpations,
                                     const std::function<Belief(std::vector<Palpation>)>& believe,
                                     const Belief& first) {
  const std::vector<std::size_t> numbers = in_time(palpations);
  std::vector<ZeroChange> changes;
  Belief belief = first;
  while (numbers.size() >= kFewest && changes.size() < kMostChanges &&
         belief.noise_variance() > 0.0 && !belief.prior().has_slope()) {
    const Steps steps(belief, palpations, numbers);
    const std::optional<ZeroChange> more = steps.another(changes);
    if (!more || !is_of_the_zero(belief)) return steps.estimated(std::move(changes));
    changes.push_back(*more);
    changes = steps.estimated(std::move(changes));
    belief = believe(with_zeros_taken_back({palpations.begin(), palpations.end()}, changes));
  }
  return changes;
}

}  // namespace palpation
