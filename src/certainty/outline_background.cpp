#include "certainty/outline_background.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpation {
namespace {

constexpr double kLength_m = 0.006;   ///< of the waves' squared exponential covariance
constexpr double kMargin = 1.5;       ///< lengths around the readings: sines end at 0
constexpr double kLeastShare = 0.01;  ///< of the greatest term's variance
constexpr int kMostTerms = 128;       ///< else the length grows
constexpr double kSdLogSd = 1.0;
constexpr double kSdStep = 1.0;
constexpr int kSdTries = 2;

struct Wave {
  Vec2 turns;    ///< radians per metre
  double share;  ///< its variance, over the greatest's
};

std::vector<Wave> waves_in(const Vec2& size_m, double length_m) {
  const double most = std::sqrt(-2.0 * std::log(kLeastShare)) / length_m;
  std::vector<Wave> waves;
  for (int i = 1; i * std::numbers::pi / size_m.x() < most; ++i) {
    for (int j = 1; j * std::numbers::pi / size_m.y() < most; ++j) {
      const Vec2 turns = std::numbers::pi * Vec2(i, j).cwiseQuotient(size_m);
      const double share = std::exp(-0.5 * length_m * length_m * turns.squaredNorm());
      if (share >= kLeastShare) waves.push_back({turns, share});
    }
  }
  return waves;
}

/// The log density of what was felt, given waves so high, but for what does not depend on that;
/// and what the coefficients are drawn from.
struct Marginal {
  Eigen::LLT<Eigen::MatrixXd> precision;  // of the coefficients over their sds
  Eigen::VectorXd sd, mean;               // over their sds
  double log_density;
};

Marginal marginal_of(const Eigen::MatrixXd& information, const Eigen::VectorXd& pull,
                     const Eigen::VectorXd& sd) {
  Eigen::MatrixXd precision = sd.asDiagonal() * information * sd.asDiagonal();
  precision.diagonal().array() += 1.0;
  Marginal marginal{precision.llt(), sd, {}, 0.0};
  const Eigen::VectorXd scaled = sd.cwiseProduct(pull);
  marginal.mean = marginal.precision.solve(scaled);
  const auto& factor = marginal.precision.matrixLLT();
  marginal.log_density = 0.5 * scaled.dot(marginal.mean) - factor.diagonal().array().log().sum();
  return marginal;
}

}  // namespace

BackgroundTerms background_terms(std::span<const Vec2> places, std::span<const double> when) {
  BackgroundTerms terms;
  if (places.empty()) return terms;
  Eigen::AlignedBox2d box;
  for (const Vec2& place : places) box.extend(place);
  double length_m = kLength_m;
  std::vector<Wave> waves;
  Vec2 corner, size_m;
  for (;; length_m *= 1.2) {
    corner = box.min().array() - kMargin * length_m;
    size_m = box.sizes().array() + 2.0 * kMargin * length_m;
    waves = waves_in(size_m, length_m);
    if (static_cast<int>(waves.size()) <= kMostTerms) break;
  }
  const auto count = static_cast<Eigen::Index>(waves.size());
  // Of the greatest term: the kernel's spectral density over the sines' squared norm.
  const double variance = 8.0 * std::numbers::pi * length_m * length_m / size_m.prod();
  terms.of_readings.resize(static_cast<Eigen::Index>(places.size()), count + 1);
  const auto [first, last] = std::ranges::minmax(when);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec2 place = places[i] - corner;
    const auto row = static_cast<Eigen::Index>(i);
    for (Eigen::Index term = 0; term < count; ++term) {
      const Wave& wave = waves[static_cast<std::size_t>(term)];
      const Vec2 phase = wave.turns.cwiseProduct(place);
      terms.of_readings(row, term) =
          std::sqrt(variance * wave.share) * std::sin(phase.x()) * std::sin(phase.y());
    }
    terms.of_readings(row, count) = last > first ? (when[i] - first) / (last - first) - 0.5 : 0.0;
  }
  return terms;
}

OutlineBackground::OutlineBackground(const BackgroundTerms& terms)
    : terms_(&terms),
      coefficients_(Eigen::VectorXd::Zero(terms.of_readings.cols())),
      added_(static_cast<std::size_t>(terms.of_readings.rows()), 0.0) {}

double OutlineBackground::waves_sd() const {
  return is_none() ? 0.0 : terms_->median_sd * std::exp(log_sd_);
}

Eigen::VectorXd OutlineBackground::sds(double log_sd) const {
  Eigen::VectorXd sd =
      Eigen::VectorXd::Constant(coefficients_.size(), terms_->median_sd * std::exp(log_sd));
  sd[sd.size() - 1] = terms_->drift_sd;
  return sd;
}

void OutlineBackground::draw(const Eigen::VectorXd& off, const Eigen::VectorXd& precision,
                             Random& random) {
  const Eigen::MatrixXd weighted = precision.asDiagonal() * terms_->of_readings;
  const Eigen::MatrixXd information = terms_->of_readings.transpose() * weighted;
  const Eigen::VectorXd pull = weighted.transpose() * off;
  Marginal now = marginal_of(information, pull, sds(log_sd_));
  for (int i = 0; i < kSdTries; ++i) {
    const double next = log_sd_ + kSdStep * random.normal();
    Marginal then = marginal_of(information, pull, sds(next));
    const double change = then.log_density - now.log_density -
                          0.5 * (next * next - log_sd_ * log_sd_) / (kSdLogSd * kSdLogSd);
    if (!(std::log(random.uniform()) < change)) continue;
    log_sd_ = next;
    now = std::move(then);
  }
  Eigen::VectorXd noise(coefficients_.size());
  for (double& one : noise) one = random.normal();
  coefficients_ = now.sd.cwiseProduct(now.mean + now.precision.matrixU().solve(noise));
  const Eigen::VectorXd added = terms_->of_readings * coefficients_;
  std::ranges::copy(added, added_.begin());
}

double OutlineBackground::log_density() const {
  if (is_none()) return 0.0;
  const Eigen::VectorXd sd = sds(log_sd_);
  return -0.5 * coefficients_.cwiseQuotient(sd).squaredNorm() - sd.array().log().sum() -
         0.5 * log_sd_ * log_sd_ / (kSdLogSd * kSdLogSd);
}

}  // namespace palpation
