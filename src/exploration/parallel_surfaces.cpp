#include "exploration/parallel_surfaces.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace palpation {
namespace {

constexpr int kRounds = 30;
/// Of the values: on neither surface, but on the way from one to the other, or wrong.
constexpr double kElsewhere = 0.1;
/// Noise below this part of the range is no noise: the likelihood would grow without bound.
constexpr double kLeastSd = 1e-3;
/// Of the values that shall lie below the first background, each weighed by how far it lies off.
constexpr std::array kBelow = {0.05, 0.2, 0.5, 0.8, 0.95};
constexpr double kFirstNoise = 0.1;  ///< of the range: a tumour's contrast is not the background's
constexpr int kWeighings = 10;

/// The background that values lie off, those above it `below` times as much as those below
/// 1 - below (Newey and Powell 1987).
Eigen::VectorXd expectile(const SharedBackground& background, const Eigen::VectorXd& values,
                          double below) {
  const Eigen::Index terms = background.terms.cols();
  Eigen::MatrixXd rows(values.size(), 1 + terms);
  rows << Eigen::VectorXd::Ones(values.size()), background.terms;
  Eigen::VectorXd weight = Eigen::VectorXd::Constant(values.size(), 0.5), found;
  for (int round = 0; round < kWeighings; ++round) {
    Eigen::MatrixXd normal = rows.transpose() * weight.asDiagonal() * rows;
    normal.diagonal().tail(terms) += kFirstNoise * kFirstNoise * background.precision;
    found = normal.ldlt().solve(rows.transpose() * weight.cwiseProduct(values));
    const Eigen::VectorXd level = rows * found;
    weight = (values.array() > level.array())
                 .select(Eigen::VectorXd::Constant(values.size(), below), 1.0 - below);
  }
  return background.terms * found.tail(terms);
}

/// The two groups that values are cut into by the split with the least squares.
ParallelSurfaces first_fit(Eigen::VectorXd left) {
  std::sort(left.begin(), left.end());
  const Eigen::Index count = left.size();
  const double all = left.sum();
  double sum = 0.0, best = -1.0;
  ParallelSurfaces fit;
  for (Eigen::Index below = 1; below < count; ++below) {
    sum += left[below - 1];
    const double low = sum / static_cast<double>(below),
                 high = (all - sum) / static_cast<double>(count - below);
    const double between =
        static_cast<double>(below) * static_cast<double>(count - below) * std::pow(high - low, 2);
    if (between <= best) continue;
    best = between;
    fit.low = low;
    fit.contrast = high - low;
    fit.high_share = static_cast<double>(count - below) / static_cast<double>(count);
  }
  const double squares = (left.array() - all / static_cast<double>(count)).square().sum() -
                         best / static_cast<double>(count);
  fit.variance = std::max(squares / static_cast<double>(count), kLeastSd * kLeastSd);
  return fit;
}

class Fitting {
 public:
  Fitting(const SharedBackground& background, const Eigen::VectorXd& values,
          const Eigen::VectorXd& first_background)
      : background_(background), values_(values), fit_(first_fit(values - first_background)) {
    fit_.coefficients = Eigen::VectorXd::Zero(background.terms.cols());
    shared_ = first_background;
  }

  ParallelSurfaces found() {
    for (int round = 0; round < kRounds; ++round) improve();
    expect();
    const Eigen::Index terms = fit_.coefficients.size();
    if (terms > 0 && background_.precision.minCoeff() > 0.0) {
      const Eigen::MatrixXd information = normal().bottomRightCorner(terms, terms) / fit_.variance;
      fit_.log_evidence = fit_.log_likelihood +
                          0.5 * (background_.precision.array().log().sum() -
                                 background_.precision.dot(fit_.coefficients.cwiseAbs2())) -
                          information.llt().matrixLLT().diagonal().array().log().sum();
    }
    return fit_;
  }

 private:
  /// How probably each value lies on either surface.
  void expect() {
    const Eigen::ArrayXd off_low =
        values_ - shared_ - Eigen::VectorXd::Constant(values_.size(), fit_.low);
    const double height = (1.0 - kElsewhere) / std::sqrt(2.0 * std::numbers::pi * fit_.variance);
    on_low_ = (1.0 - fit_.high_share) * height * (-0.5 * off_low.square() / fit_.variance).exp();
    on_high_ = fit_.high_share * height *
               (-0.5 * (off_low - fit_.contrast).square() / fit_.variance).exp();
    const Eigen::ArrayXd sum = on_low_ + on_high_ + kElsewhere;
    fit_.log_likelihood = sum.log().sum();
    on_low_ /= sum;
    on_high_ /= sum;
  }

  /// Of low, contrast and the coefficients: weighted least squares, and what is known beforehand.
  Eigen::MatrixXd normal() const {
    const Eigen::MatrixXd& terms = background_.terms;
    const Eigen::VectorXd on_either = on_low_ + on_high_;
    const double high = on_high_.sum();
    Eigen::MatrixXd normal(2 + terms.cols(), 2 + terms.cols());
    normal.topLeftCorner<2, 2>() << on_either.sum(), high, high, high;
    normal.block(0, 2, 1, terms.cols()) = on_either.transpose() * terms;
    normal.block(1, 2, 1, terms.cols()) = on_high_.matrix().transpose() * terms;
    normal.bottomLeftCorner(terms.cols(), 2) = normal.topRightCorner(2, terms.cols()).transpose();
    normal.bottomRightCorner(terms.cols(), terms.cols()) =
        terms.transpose() * on_either.asDiagonal() * terms;
    normal.diagonal().tail(terms.cols()) += fit_.variance * background_.precision;
    normal.diagonal().array() += 1e-9 * on_either.sum();
    return normal;
  }

  void improve() {
    expect();
    const Eigen::ArrayXd on_either = on_low_ + on_high_;
    const double on_surfaces = on_either.sum();
    if (!(on_surfaces > 0.0)) return;
    Eigen::VectorXd right(2 + fit_.coefficients.size());
    right << on_either.matrix().dot(values_), on_high_.matrix().dot(values_),
        background_.terms.transpose() * (on_either * values_.array()).matrix();
    const Eigen::VectorXd found = normal().ldlt().solve(right);
    fit_.low = found[0];
    fit_.contrast = found[1];
    fit_.coefficients = found.tail(fit_.coefficients.size());
    shared_ = background_.terms * fit_.coefficients;
    const Eigen::ArrayXd off_low = (values_ - shared_).array() - fit_.low;
    const double squares =
        (on_low_ * off_low.square() + on_high_ * (off_low - fit_.contrast).square()).sum();
    fit_.variance = std::max(squares / on_surfaces, kLeastSd * kLeastSd);
    const double least = 1.0 / static_cast<double>(values_.size());
    fit_.high_share = std::clamp(on_high_.sum() / on_surfaces, least, 1.0 - least);
  }

  const SharedBackground& background_;
  const Eigen::VectorXd& values_;
  ParallelSurfaces fit_;
  Eigen::VectorXd shared_;  // what the background adds to each value
  Eigen::ArrayXd on_low_, on_high_;
};

}  // namespace

ParallelSurfaces parallel_surfaces(const SharedBackground& background,
                                   const Eigen::VectorXd& values,
                                   const Eigen::VectorXd& first_background) {
  return Fitting(background, values, first_background).found();
}

std::vector<ParallelSurfaces> all_parallel_surfaces(const SharedBackground& background,
                                                    const Eigen::VectorXd& values) {
  std::vector<ParallelSurfaces> all = {
      parallel_surfaces(background, values, Eigen::VectorXd::Zero(values.size()))};
  for (const double below : kBelow)
    all.push_back(parallel_surfaces(background, values, expectile(background, values, below)));
  return all;
}

SomeValues some_of(const Eigen::VectorXd& values, std::span<const std::size_t> order,
                   std::size_t most) {
  const std::size_t step = (order.size() + most - 1) / most;
  SomeValues some;
  for (std::size_t i = 0; i < order.size(); i += step) some.rows.push_back(order[i]);
  some.scaled = values(some.rows);
  const double least = some.scaled.minCoeff();
  some.range = some.scaled.maxCoeff() - least;
  if (some.range > 0.0) some.scaled = (some.scaled.array() - least) / some.range;
  return some;
}

}  // namespace palpation
