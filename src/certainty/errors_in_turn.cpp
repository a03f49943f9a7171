#include "certainty/errors_in_turn.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "certainty/few_terms.h"

namespace palpation {
namespace {

constexpr double kLonger = 1.2;

double alike(std::span<const Made> one, std::span<const Made> other, double readings) {
  double sum = 0.0;
  for (const Made& a : one) {
    for (const Made& b : other) {
      const auto [earlier, later] = std::minmax(a.number, b.number);
      sum += std::exp(-static_cast<double>(later - earlier) / readings);
    }
  }
  return sum / static_cast<double>(one.size() * other.size());
}

}  // namespace

Eigen::MatrixXd errors_in_turn(std::span<const std::vector<Made>> made, double readings) {
  const auto count = static_cast<Eigen::Index>(made.size());
  Eigen::MatrixXd errors(count, count);
  for (Eigen::Index a = 0; a < count; ++a) {
    for (Eigen::Index b = 0; b <= a; ++b)
      errors(a, b) = errors(b, a) =
          alike(made[static_cast<std::size_t>(a)], made[static_cast<std::size_t>(b)], readings);
  }
  return errors;
}

Eigen::MatrixXd errors_at_each(Eigen::Index count, std::span<const std::vector<Made>> made,
                               double readings) {
  Eigen::MatrixXd errors(count, static_cast<Eigen::Index>(made.size()));
  for (Eigen::Index number = 0; number < count; ++number) {
    const Made one{.number = static_cast<std::size_t>(number)};
    for (Eigen::Index column = 0; column < errors.cols(); ++column)
      errors(number, column) = alike({&one, 1}, made[static_cast<std::size_t>(column)], readings);
  }
  return errors;
}

Eigen::VectorXd mean_in_turn(const Eigen::VectorXd& of_each,
                             std::span<const std::vector<Made>> made) {
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(made.size()));
  for (std::size_t row = 0; row < made.size(); ++row) {
    for (const Made& one : made[row])
      mean[static_cast<Eigen::Index>(row)] +=
          of_each[static_cast<Eigen::Index>(one.number)] / static_cast<double>(made[row].size());
  }
  return mean;
}

Eigen::MatrixXd terms_of_errors(std::span<const std::vector<Made>> made, double readings,
                                Eigen::Index most) {
  for (;; readings *= kLonger) {
    const Eigen::MatrixXd errors = errors_in_turn(made, readings);
    FewTermsOptions options{.most = most};
    if (errors.size() > 0) errors.diagonal().maxCoeff(&options.first_pivot);
    FewTerms few = few_terms(errors, options);
    if (few.is_whole) return std::move(few.terms);
  }
}

}  // namespace palpation
