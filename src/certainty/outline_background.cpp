#include "certainty/outline_background.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "certainty/few_terms.h"

namespace palpation {
namespace {

/// Of the waves' squared exponential covariances.
constexpr std::array kLengths_m = {0.0035, 0.008};
constexpr double kLeftOut = 0.02;  ///< of their variance at any reading, at most

/// The waves' covariance over their variance.
FewTerms waves_at(std::span<const Vec2> places, double length_m) {
  const auto count = static_cast<Eigen::Index>(places.size());
  Vec2 middle = Vec2::Zero();
  for (const Vec2& place : places) middle += place / static_cast<double>(count);
  const auto from_middle = [&](const Vec2& place) { return (place - middle).squaredNorm(); };
  const auto alike = [&](Eigen::Index pivot) {
    Eigen::VectorXd waves(count);
    for (Eigen::Index row = 0; row < count; ++row) {
      const double square = (places[row] - places[pivot]).squaredNorm() / (length_m * length_m);
      waves[row] = std::exp(-0.5 * square);
    }
    return waves;
  };
  return few_terms(
      Eigen::VectorXd::Ones(count), alike,
      {.left_out = kLeftOut,
       .first_pivot = std::ranges::min_element(places, {}, from_middle) - places.begin(),
       .most = kMostOfOneKind});
}

/// Of each reading, from -1/2 for the first to 1/2 for the last.
Eigen::VectorXd drift_of(std::span<const double> when) {
  Eigen::VectorXd drift =
      Eigen::Map<const Eigen::VectorXd>(when.data(), static_cast<Eigen::Index>(when.size()));
  const double first = drift.minCoeff(), last = drift.maxCoeff();
  if (!(last > first)) return Eigen::VectorXd::Zero(drift.size());
  return (drift.array() - first) / (last - first) - 0.5;
}

/// Of each reading, along x and y.
Eigen::MatrixXd tilt_of(std::span<const Vec2> places) {
  const auto count = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd tilt(count, 2);
  for (Eigen::Index row = 0; row < count; ++row) tilt.row(row) = places[row].transpose();
  tilt.rowwise() -= tilt.colwise().mean().eval();
  const double radius_m = std::sqrt(tilt.squaredNorm() / static_cast<double>(count));
  return radius_m > 0.0 ? Eigen::MatrixXd(tilt / radius_m) : tilt;
}

}  // namespace

BackgroundTerms background_terms(const BackgroundReadings& readings) {
  BackgroundTerms terms;
  if (readings.places.empty()) return terms;
  std::vector<Eigen::MatrixXd> parts;
  for (double length_m : kLengths_m) {
    FewTerms waves = waves_at(readings.places, length_m);
    for (; !waves.is_whole; length_m *= 1.2) waves = waves_at(readings.places, length_m);
    terms.waves.push_back(waves.terms.cols());
    parts.push_back(std::move(waves.terms));
  }
  parts.emplace_back(drift_of(readings.when));
  parts.push_back(tilt_of(readings.places));
  parts.push_back(readings.seen);
  terms.seen = readings.seen.cols();
  parts.push_back(readings.steps);
  terms.step_sd = Eigen::VectorXd::Ones(readings.steps.cols());
  Eigen::Index columns = 0;
  for (const Eigen::MatrixXd& part : parts) columns += part.cols();
  terms.of_readings.resize(static_cast<Eigen::Index>(readings.places.size()), columns);
  columns = 0;
  for (const Eigen::MatrixXd& part : parts) {
    if (part.cols() > 0) terms.of_readings.middleCols(columns, part.cols()) = part;
    columns += part.cols();
  }
  return terms;
}

Eigen::MatrixXd information_of(const BackgroundTerms& terms, std::span<const double> variance) {
  if (terms.is_none()) return {};
  const Eigen::Map<const Eigen::VectorXd> of_each(variance.data(), terms.of_readings.rows());
  return terms.of_readings.transpose() * of_each.cwiseInverse().asDiagonal() * terms.of_readings;
}

}  // namespace palpation
