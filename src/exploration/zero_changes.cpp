#include "exploration/zero_changes.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "base/log_mean.h"
#include "exploration/taken_back.h"
#include "readings/readings.h"

namespace palpation {
namespace {

/// Readings that are looked at: a step shows in as many, and the cost grows with the third power.
constexpr std::size_t kMost = 200;
constexpr std::size_t kFewest = 12;
/// Of the constant that all readings share, of the field's standard deviation: it is not known.
constexpr double kConstant = 30.0;
/// Whose ground a place is on, so many of the readings nearest to it say, all but one.
constexpr std::size_t kNeighbours = 4;

/// Of each reading, those nearest to it.
std::vector<std::vector<std::size_t>> neighbours_of(const std::vector<Vec3>& places) {
  std::vector<std::vector<std::size_t>> all;
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::vector<std::pair<double, std::size_t>> others;
    for (std::size_t j = 0; j < places.size(); ++j) {
      if (j != i) others.emplace_back((places[j] - places[i]).squaredNorm(), j);
    }
    const auto most = others.begin() + kNeighbours;
    std::partial_sort(others.begin(), most, others.end());
    std::vector<std::size_t>& near = all.emplace_back();
    for (auto other = others.begin(); other != most; ++other) near.push_back(other->second);
  }
  return all;
}

/// Steps in readings of a field with a constant that is not known.
class Steps {
 public:
  Steps(const Belief& belief, std::span<const Palpation> palpations,
        std::span<const std::size_t> numbers)
      : palpations_(palpations), numbers_(numbers), variance_(square(belief.signal_sd())) {
    std::vector<SurfacePoint> places;
    std::vector<Vec3> positions;
    for (const std::size_t i : numbers) {
      places.push_back(palpations[i].where);
      positions.push_back(belief.prior().coordinates(places.back()));
    }
    neighbours_ = neighbours_of(positions);
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

  /// What each of the changes adds, all at once. Of sessions any is as likely.
  std::vector<Misfit> estimated(std::vector<Misfit> changes) const {
    if (changes.empty()) return changes;
    const Eigen::MatrixXd steps = columns(changes);
    const Eigen::MatrixXd precision = precision_of(changes, steps);
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
  std::optional<Misfit> another(const std::vector<Misfit>& known) const {
    Eigen::MatrixXd inverse = inverse_;
    if (!known.empty()) {
      const Eigen::MatrixXd steps = columns(known), weighed = inverse_ * steps;
      inverse -= weighed * precision_of(known, steps).llt().solve(weighed.transpose());
    }
    const Eigen::VectorXd pull = inverse * readings_;
    const double before = readings_.dot(pull);
    const auto evidence_of = [&](const Eigen::VectorXd& added) {
      const double a = added.dot(inverse * added), b = added.dot(pull);
      return 0.5 * static_cast<double>(added.size()) *
                 std::log(before / (before - square(b) / (a + 1.0 / variance_))) -
             0.5 * std::log1p(a * variance_);
    };
    LogMean steps_in_time, steps_in_space;
    double best = -std::numeric_limits<double>::infinity();
    Eigen::Index first = 0;
    for (Eigen::Index i = 1; i < readings_.size(); ++i) {
      const Eigen::VectorXd step = Eigen::VectorXd::NullaryExpr(
          readings_.size(), [&](Eigen::Index row) { return row >= i ? 1.0 : 0.0; });
      const double evidence = evidence_of(step);
      steps_in_time.add(evidence);
      steps_in_space.add(evidence_of(in_space(step)));
      if (evidence > best) best = evidence, first = i;
    }
    const double mean = steps_in_time.value() - std::max(0.0, steps_in_space.value());
    if (!(mean > surprising())) return std::nullopt;
    const std::size_t number = numbers_[static_cast<std::size_t>(first)];
    return Misfit{.kind = MisfitKind::Zero,
                  .evidence = mean,
                  .from_batch = palpations_[number].batch,
                  .number = number};
  }

 private:
  static double square(double value) { return value * value; }

  /// The step that the tissue itself would make, whose readings are high on the ground where those
  /// since then were made: each as those around it.
  Eigen::VectorXd in_space(const Eigen::VectorXd& in_time) const {
    Eigen::VectorXd in_space = in_time;
    for (std::size_t i = 0; i < neighbours_.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const auto differs = [&](std::size_t near) {
        return in_time[static_cast<Eigen::Index>(near)] != in_time[row];
      };
      const auto others = std::ranges::count_if(neighbours_[i], differs);
      if (others + 1 >= static_cast<std::ptrdiff_t>(kNeighbours))
        in_space[row] = 1.0 - in_time[row];
    }
    return in_space;
  }

  Eigen::MatrixXd columns(const std::vector<Misfit>& changes) const {
    Eigen::MatrixXd steps(readings_.size(), static_cast<Eigen::Index>(changes.size()));
    for (Eigen::Index i = 0; i < steps.rows(); ++i) {
      const std::size_t number = numbers_[static_cast<std::size_t>(i)];
      for (Eigen::Index j = 0; j < steps.cols(); ++j)
        steps(i, j) = is_since(changes[static_cast<std::size_t>(j)],
                               {palpations_[number].batch, number, palpations_[number].session});
    }
    return steps;
  }

  Eigen::MatrixXd precision_of(const std::vector<Misfit>& changes,
                               const Eigen::MatrixXd& steps) const {
    Eigen::MatrixXd precision = steps.transpose() * inverse_ * steps;
    for (Eigen::Index i = 0; i < precision.rows(); ++i) {
      const bool is_of_session = changes[static_cast<std::size_t>(i)].session > 0;
      precision(i, i) += 1.0 / (variance_ * (is_of_session ? square(kConstant) : 1.0));
    }
    return precision;
  }

  std::span<const Palpation> palpations_;
  std::span<const std::size_t> numbers_;
  double variance_;  // of a step
  Eigen::VectorXd readings_;
  Eigen::MatrixXd inverse_;
  std::vector<std::vector<std::size_t>> neighbours_;
};

bool is_of_the_zero(const Belief& belief) {
  const std::optional<Misfit> change = changed_since(belief);
  return change && change->kind == MisfitKind::Zero;
}

/// Of readings of a session beside the nearest ones of those before it, over the closer half.
double apart_by(const Surface& surface, std::span<const Palpation> palpations, int session) {
  std::vector<std::pair<double, double>> apart;  // places, readings
  for (const Palpation& one : palpations) {
    if (!counts(one) || one.session != session) continue;
    const Vec3 here = surface.position(one.where);
    std::pair nearest(std::numeric_limits<double>::infinity(), 0.0);
    for (const Palpation& other : palpations) {
      if (!counts(other) || other.session >= session) continue;
      nearest = std::min(nearest, {(surface.position(other.where) - here).squaredNorm(),
                                   one.reading - other.reading});
    }
    apart.push_back(nearest);
  }
  std::ranges::sort(apart);
  apart.resize((apart.size() + 1) / 2);
  std::ranges::sort(apart, {}, [](const auto& pair) { return pair.second; });
  return apart[apart.size() / 2].second;
}

}  // namespace

std::vector<Misfit> session_zeros(const Surface& surface, std::span<const Palpation> palpations) {
  std::vector<Misfit> changes;
  std::map<int, std::size_t> first_of;
  for (std::size_t i = 0; i < palpations.size(); ++i) {
    if (counts(palpations[i])) first_of.try_emplace(palpations[i].session, i);
  }
  for (const auto& [session, number] : first_of) {
    if (session == first_of.begin()->first) continue;
    // Those before it have zeros of their own: taken from all, what is left is this one's.
    std::vector<Palpation> others =
        with_changes_taken_back(surface, {palpations.begin(), palpations.end()}, changes);
    changes.push_back({.kind = MisfitKind::Zero,
                       .from_batch = palpations[number].batch,
                       .number = number,
                       .session = session,
                       .amount = apart_by(surface, others, session)});
  }
  return changes;
}

std::vector<Misfit> estimated_zeros(std::span<const Palpation> palpations, const Belief& belief,
                                    std::vector<Misfit> changes) {
  const std::vector<std::size_t> numbers = in_time(palpations, kMost);
  if (numbers.size() < kFewest) return changes;
  // What is left of them: of a large zero itself the prior would take a part.
  const std::vector<Palpation> without = with_changes_taken_back(
      belief.prior().surface(), {palpations.begin(), palpations.end()}, changes);
  const std::vector<Misfit> left = Steps(belief, without, numbers).estimated(changes);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    changes[i].amount += left[i].amount;
    changes[i].stddev = left[i].stddev;
  }
  return changes;
}

std::vector<Misfit> zero_changes(std::span<const Palpation> palpations,
                                 const std::function<Belief(std::vector<Palpation>)>& believe,
                                 const Belief& first) {
  const std::vector<std::size_t> numbers = in_time(palpations, kMost);
  std::vector<Misfit> changes;
  Belief belief = first;
  while (numbers.size() >= kFewest && changes.size() < kMostChanges &&
         belief.noise_variance() > 0.0 && !belief.prior().has_slope()) {
    const Steps steps(belief, palpations, numbers);
    const std::optional<Misfit> more = steps.another(changes);
    if (!more || !is_of_the_zero(belief)) return steps.estimated(std::move(changes));
    changes.push_back(*more);
    changes = steps.estimated(std::move(changes));
    belief = believe(with_changes_taken_back(first.prior().surface(),
                                             {palpations.begin(), palpations.end()}, changes));
  }
  return changes;
}

}  // namespace palpation
