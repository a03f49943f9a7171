#include "exploration/drift.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "certainty/errors_in_turn.h"
#include "certainty/few_terms.h"
#include "exploration/parallel_surfaces.h"

namespace palpation {
namespace {

constexpr std::size_t kFewest = 15;
constexpr std::size_t kMost = 200;  ///< of which all are used: each is known from those beside it
/// Over so many readings, and so high, of the readings' range.
constexpr std::array kInTurn = {10.0, 30.0, 100.0};
constexpr std::array kHeights = {0.3, 1.0};
/// Of their variance, what does not last: else two at one moment could not differ.
constexpr double kOfOneReading = 0.05;
/// Two that differ by less are one, of the range: root mean square.
constexpr double kSame = 0.05;

/// The rows as their readings were made.
std::vector<std::size_t> in_turn(const EdgeData& readings) {
  std::vector<std::size_t> order(readings.made.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {},
                           [&](std::size_t i) { return readings.made[i].front().number; });
  return order;
}

struct Candidate {
  double log_evidence = 0.0;
  Eigen::VectorXd drift;  ///< of each reading, of the range
};

}  // namespace

std::vector<Eigen::VectorXd> drifts_of_parallel_lines(const EdgeData& readings, Eigen::Index count,
                                                      double needed, std::size_t most) {
  if (readings.places.size() < kFewest) return {};
  const auto [rows, values, range] = some_of(readings.reading, in_turn(readings), kMost);
  if (!(range > 0.0)) return {};
  std::vector<std::vector<Made>> made;
  for (const std::size_t row : rows) made.push_back(readings.made[row]);
  const Eigen::MatrixXd no_terms(values.size(), 0);
  const double level =
      parallel_surfaces({no_terms, {}}, values, Eigen::VectorXd::Zero(values.size()))
          .log_likelihood;
  std::vector<Candidate> candidates;
  for (const double in_turn : kInTurn) {
    const Eigen::MatrixXd alike = errors_in_turn(made, in_turn), terms = few_terms(alike).terms,
                          at_each = errors_at_each(count, made, in_turn);
    Eigen::MatrixXd of_readings = alike;
    of_readings.diagonal().array() += kOfOneReading;
    const Eigen::LLT<Eigen::MatrixXd> known(of_readings);
    for (const double height : kHeights) {
      const SharedBackground errors{
          terms, Eigen::VectorXd::Constant(terms.cols(), 1.0 / (height * height))};
      for (const ParallelSurfaces& lines : all_parallel_surfaces(errors, values)) {
        if (lines.log_evidence > level + needed)
          candidates.push_back(
              {lines.log_evidence, at_each * known.solve(terms * lines.coefficients)});
      }
    }
  }
  std::ranges::stable_sort(candidates, std::greater{}, &Candidate::log_evidence);
  std::vector<Eigen::VectorXd> told;
  for (const Candidate& one : candidates) {
    const auto is_known = [&](const Eigen::VectorXd& other) {
      const Eigen::ArrayXd apart = other / range - one.drift;
      return (apart - apart.mean()).matrix().norm() < kSame * std::sqrt(static_cast<double>(count));
    };
    if (told.size() < most && std::ranges::none_of(told, is_known))
      told.push_back(range * one.drift);
  }
  return told;
}

}  // namespace palpation
