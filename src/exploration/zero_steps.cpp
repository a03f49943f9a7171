#include "exploration/zero_steps.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "base/log_mean.h"
#include "readings/readings.h"

namespace palpation {
namespace {

/// Of the constant that all readings share, of the field's standard deviation: it is not known.
constexpr double kConstant = 30.0;
/// Whose ground a place is on, so many of the readings nearest to it say, all but one, if it is one
/// of the nearest to any of them: else it lies beside readings that are close to each other.
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

double square(double value) { return value * value; }

Prior with_signal_of(const Belief& belief) {
  Kernel kernel = belief.prior().kernel();
  kernel.signal_sd = belief.signal_sd();
  return belief.prior().with(kernel);
}

}  // namespace

ZeroSteps::ZeroSteps(const Belief& belief, std::span<const Palpation> palpations,
                     std::span<const std::size_t> numbers)
    : palpations_(palpations),
      numbers_(numbers),
      prior_(with_signal_of(belief)),
      variance_(square(belief.signal_sd())) {
  std::vector<Vec3> positions;
  for (const std::size_t i : numbers) {
    places_.push_back(palpations[i].where);
    positions.push_back(prior_.coordinates(places_.back()));
  }
  neighbours_ = neighbours_of(positions);
  const auto count = static_cast<Eigen::Index>(numbers.size());
  Eigen::MatrixXd covariance = covariance_with(places_);
  readings_.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Palpation& one = palpations[numbers[static_cast<std::size_t>(i)]];
    readings_[i] = one.reading;
    covariance(i, i) +=
        std::isnan(one.noise_variance) ? belief.noise_variance() : one.noise_variance;
  }
  middle_ = readings_.mean();
  readings_.array() -= middle_;
  inverse_ = covariance.llt().solve(Eigen::MatrixXd::Identity(count, count));
}

std::vector<Misfit> ZeroSteps::estimated(std::vector<Misfit> changes) const {
  if (changes.empty()) return changes;
  const Eigen::MatrixXd steps = columns(changes, numbers_);
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

Misfit ZeroSteps::sharpened(const std::vector<Misfit>& changes) const {
  Misfit step = changes.back();
  const auto found = std::ranges::lower_bound(numbers_, step.number);
  if (found == numbers_.begin()) return step;
  std::vector<std::size_t> between;
  std::vector<SurfacePoint> places;
  for (std::size_t i = *std::prev(found) + 1; i < step.number; ++i) {
    if (!counts(palpations_[i])) continue;
    between.push_back(i);
    places.push_back(palpations_[i].where);
  }
  if (between.empty()) return step;
  Eigen::VectorXd amounts(static_cast<Eigen::Index>(changes.size()));
  for (std::size_t i = 0; i < changes.size(); ++i)
    amounts[static_cast<Eigen::Index>(i)] = changes[i].amount;
  const Eigen::VectorXd left = inverse_ * (readings_ - columns(changes, numbers_) * amounts),
                        expected = covariance_with(places).transpose() * left +
                                   columns(changes, between) * amounts;  // as before the step
  double gained = 0.0, most = 0.0;  // by beginning with each, over with the one that was found
  for (std::size_t i = between.size(); i-- > 0;) {
    const Palpation& one = palpations_[between[i]];
    const double off = one.reading - middle_ - expected[static_cast<Eigen::Index>(i)];
    gained += square(off) - square(off - step.amount);
    if (!(gained > most)) continue;
    most = gained;
    step.number = between[i];
    step.from_batch = one.batch;
  }
  return step;
}

/// The likeliest step, and the mean over all moments of what such steps explain.
struct ZeroSteps::Found {
  Eigen::Index first = 0;
  double best = -std::numeric_limits<double>::infinity();
  LogMean in_time, in_space;
};

ZeroSteps::Found ZeroSteps::found_beside(const std::vector<Misfit>& known) const {
  Eigen::MatrixXd inverse = inverse_;
  if (!known.empty()) {
    const Eigen::MatrixXd steps = columns(known, numbers_), weighed = inverse_ * steps;
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
  Found found;
  for (Eigen::Index i = 1; i < readings_.size(); ++i) {
    const Eigen::VectorXd step = Eigen::VectorXd::NullaryExpr(
        readings_.size(), [&](Eigen::Index row) { return row >= i ? 1.0 : 0.0; });
    const double evidence = evidence_of(step);
    found.in_time.add(evidence);
    found.in_space.add(evidence_of(in_space(step)));
    if (evidence > found.best) found.best = evidence, found.first = i;
  }
  return found;
}

std::optional<Misfit> ZeroSteps::surprising_at(Eigen::Index first, double evidence) const {
  if (!(evidence > surprising())) return std::nullopt;
  const std::size_t number = numbers_[static_cast<std::size_t>(first)];
  return Misfit{.kind = MisfitKind::Zero,
                .evidence = evidence,
                .from_batch = palpations_[number].batch,
                .number = number};
}

std::optional<Misfit> ZeroSteps::another(const std::vector<Misfit>& known) const {
  const Found found = found_beside(known);
  return surprising_at(found.first, found.in_time.value() - std::max(0.0, found.in_space.value()));
}

std::optional<Misfit> ZeroSteps::by_zero_or_tissue() const {
  const Found found = found_beside({});
  return surprising_at(found.first, found.in_time.value());
}

/// Of the readings that are looked at (rows), without noise, with those at other places.
Eigen::MatrixXd ZeroSteps::covariance_with(std::span<const SurfacePoint> places) const {
  Eigen::MatrixXd covariance = prior_.covariance(places_, places);
  covariance.array() += square(kConstant) * variance_;
  return covariance;
}

/// The step that the tissue itself would make, whose readings are high on the ground where those
/// since then were made: each as those around it.
Eigen::VectorXd ZeroSteps::in_space(const Eigen::VectorXd& in_time) const {
  Eigen::VectorXd in_space = in_time;
  for (std::size_t i = 0; i < neighbours_.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const auto differs = [&](std::size_t near) {
      return in_time[static_cast<Eigen::Index>(near)] != in_time[row];
    };
    const auto is_among = [&](std::size_t near) {
      return differs(near) && std::ranges::find(neighbours_[near], i) != neighbours_[near].end();
    };
    const auto others = std::ranges::count_if(neighbours_[i], differs);
    if (others + 1 >= std::ssize(neighbours_[i]) && std::ranges::any_of(neighbours_[i], is_among))
      in_space[row] = 1.0 - in_time[row];
  }
  return in_space;
}

/// 1 in the rows of the readings with these numbers that a change came before.
Eigen::MatrixXd ZeroSteps::columns(const std::vector<Misfit>& changes,
                                   std::span<const std::size_t> numbers) const {
  Eigen::MatrixXd steps(std::ssize(numbers), std::ssize(changes));
  for (Eigen::Index i = 0; i < steps.rows(); ++i) {
    const std::size_t number = numbers[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < steps.cols(); ++j)
      steps(i, j) = is_since(changes[static_cast<std::size_t>(j)], made_of(palpations_, number));
  }
  return steps;
}

Eigen::MatrixXd ZeroSteps::precision_of(const std::vector<Misfit>& changes,
                                        const Eigen::MatrixXd& steps) const {
  Eigen::MatrixXd precision = steps.transpose() * inverse_ * steps;
  for (Eigen::Index i = 0; i < precision.rows(); ++i) {
    const bool is_of_session = changes[static_cast<std::size_t>(i)].session > 0;
    precision(i, i) += 1.0 / (variance_ * (is_of_session ? square(kConstant) : 1.0));
  }
  return precision;
}

}  // namespace palpation
