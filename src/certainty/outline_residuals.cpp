#include "certainty/outline_residuals.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/normal.h"
#include "certainty/wild_readings.h"

namespace palpation {
namespace {

constexpr double kSdLogSd = 1.0;
constexpr double kSdStep = 1.0;
constexpr std::size_t kDriftAndTilt = 2;
constexpr int kNoiseTries = 2;
constexpr std::array kGrowthSteps = {0.3, 0.1};

}  // namespace

/// Of the readings that tell, over the noise's scale; and what of the log density depends on none.
struct OutlineResiduals::Told {
  Eigen::MatrixXd information;  ///< F' V^-1 F
  Eigen::VectorXd weighed;      ///< F' V^-1 off
  double square = 0.0;          ///< off' V^-1 off
  int count = 0;
  double log_constant = 0.0;
};

/// The log density by some scales, and the coefficients over their sds.
struct OutlineResiduals::Marginal {
  Eigen::LLT<Eigen::MatrixXd> precision;
  Eigen::VectorXd sd, mean;
  double log_density = 0.0;
};

OutlineResiduals::OutlineResiduals(const OutlineReadings& readings, std::vector<double> off,
                                   const ResidualPrior& prior, double log_noise)
    : readings_(&readings),
      prior_(prior),
      off_(std::move(off)),
      told_(readings.bounds.empty() ? std::vector<double>{} : off_),
      scatter_(scatter_of(readings.variance)),
      information_(information_of(readings.background, readings.variance)),
      scales_{.log_noise = std::max(log_noise, prior.least_log_noise),
              .log_sd = std::vector(terms().waves.size(), 0.0),
              .wild = kWildPart,
              .has = std::vector(terms().waves.size() + kDriftAndTilt, true)} {
  factor();
}

void OutlineResiduals::consider(std::size_t reading, double off) {
  change_.considered.emplace_back(reading, off);
  if (!tells(reading)) return;
  if (is_bound(reading)) {
    if (!ToldAtEnd{readings_->bounds[reading], off}.allows(off_[reading]))
      change_.local = -std::numeric_limits<double>::infinity();
    return;
  }
  const double before = off_[reading],
               precision = scatter_.precision[reading] * std::exp(-2.0 * scales_.log_noise);
  change_.local -= 0.5 * precision * (off * off - before * before);
  change_.pull.noalias() += (off - before) * columns_.col(static_cast<Eigen::Index>(reading));
}

double OutlineResiduals::change() const {
  return change_.local + pull_.dot(change_.pull) + 0.5 * change_.pull.squaredNorm();
}

void OutlineResiduals::keep() {
  for (const auto& [reading, off] : change_.considered) {
    if (is_bound(reading))
      told_[reading] = off;
    else
      off_[reading] = off;
  }
  pull_ += change_.pull;
  forget();
}

void OutlineResiduals::forget() {
  change_.considered.clear();
  change_.pull.setZero();
  change_.local = 0.0;
}

OutlineResiduals::Told OutlineResiduals::told() const {
  Told told{.information = information_,
            .weighed = Eigen::VectorXd::Zero(information_.rows()),
            .log_constant = (kWildBefore - 1) * std::log(scales_.wild) +
                            (kTellingBefore - 1) * std::log1p(-scales_.wild)};
  told.log_constant += log_growth_density(scales_.growth);
  for (std::size_t i = 0; i < off_.size(); ++i) {
    if (tells(i)) {
      ++told.count;
      told.square += scatter_.precision[i] * off_[i] * off_[i];
      told.log_constant += std::log1p(-scales_.wild) +
                           0.5 * std::log(0.5 * scatter_.precision[i] / std::numbers::pi);
    } else {
      told.log_constant += std::log(scales_.wild * prior_.wild_density);
    }
    if (terms().is_none()) continue;
    const auto row = terms().of_readings.row(static_cast<Eigen::Index>(i));
    if (tells(i)) {
      told.weighed += scatter_.precision[i] * off_[i] * row.transpose();
    } else {
      told.information.noalias() -= 1.0 / scatter_.variance[i] * row.transpose() * row;
    }
  }
  return told;
}

Eigen::VectorXd OutlineResiduals::sds(const ResidualScales& scales) const {
  Eigen::VectorXd sd = Eigen::VectorXd::Zero(information_.rows());
  Eigen::Index first = 0;
  for (std::size_t length = 0; length < scales.log_sd.size(); ++length) {
    if (scales.has[length])
      sd.segment(first, terms().waves[length])
          .setConstant(terms().median_sd * std::exp(scales.log_sd[length]));
    first += terms().waves[length];
  }
  if (first < sd.size()) {
    const auto [drifts, tilts] =
        std::pair(scales.has[scales.log_sd.size()], scales.has[scales.log_sd.size() + 1]);
    if (drifts) sd[first] = terms().drift_sd;
    if (tilts) sd.segment(first + 1, 2).setConstant(terms().tilt_sd);
    sd.segment(first + 3, terms().seen).setOnes();
  }
  sd.tail(terms().steps()) = terms().step_sd;
  return sd;
}

OutlineResiduals::Marginal OutlineResiduals::marginal_of(const Told& told,
                                                         const ResidualScales& scales) const {
  const double scale = std::exp(-2.0 * scales.log_noise);
  Marginal marginal{.precision = {}, .sd = sds(scales), .mean = {}};
  double& sum = marginal.log_density;
  sum = told.log_constant - 0.5 * scale * told.square - told.count * scales.log_noise -
        half_square((scales.log_noise - prior_.log_noise) / prior_.noise_log_sd);
  for (const double log_sd : scales.log_sd) sum -= half_square(log_sd / kSdLogSd);
  if (terms().is_none()) return marginal;
  Eigen::MatrixXd precision =
      scale * (marginal.sd.asDiagonal() * told.information * marginal.sd.asDiagonal());
  precision.diagonal().array() += 1.0;
  marginal.precision.compute(precision);
  const Eigen::VectorXd pull = scale * marginal.sd.cwiseProduct(told.weighed);
  marginal.mean = marginal.precision.solve(pull);
  sum +=
      0.5 * pull.dot(marginal.mean) - marginal.precision.matrixLLT().diagonal().array().log().sum();
  return marginal;
}

double OutlineResiduals::log_density() const { return marginal_of(told(), scales_).log_density; }

Eigen::VectorXd OutlineResiduals::redraw(Random& random, bool keeps_telling) {
  const Told told = this->told();
  Marginal now = marginal_of(told, scales_);
  const auto takes = [&] {
    Marginal then = marginal_of(told, scales_);
    if (scales_.log_noise < prior_.least_log_noise ||
        !(std::log(random.uniform()) < then.log_density - now.log_density))
      return false;
    now = std::move(then);
    return true;
  };
  const auto move = [&](double& scale, double step) {
    const double before = std::exchange(scale, scale + step * random.normal());
    if (!takes()) scale = before;
  };
  // Of a variance that so many readings tell.
  const double noise_step = 1.7 / std::sqrt(told.count + 10.0);
  for (int i = 0; i < kNoiseTries; ++i) move(scales_.log_noise, noise_step);
  for (double& log_sd : scales_.log_sd) move(log_sd, kSdStep);
  if (!terms().is_none()) {
    for (std::size_t kind = 0; kind < scales_.has.size(); ++kind) {
      // Every second time: what is always taken would be there in every second draw, in turn.
      if (random.uniform() < 0.5) continue;
      scales_.has[kind].flip();
      if (!takes()) scales_.has[kind].flip();
    }
  }
  Eigen::VectorXd steps, noise = Eigen::Map<const Eigen::VectorXd>(
                             off_.data(), static_cast<Eigen::Index>(off_.size()));
  if (!terms().is_none()) {
    Eigen::VectorXd coefficients(now.mean.size());
    for (double& one : coefficients) one = random.normal();
    coefficients = now.sd.cwiseProduct(now.mean + now.precision.matrixU().solve(coefficients));
    noise -= terms().of_readings * coefficients;
    steps = coefficients.tail(terms().steps());
  }
  redraw_growth(noise, random);
  if (!keeps_telling) redraw_telling(noise, random);
  redraw_bounded(noise, random);
  factor();
  return steps;
}

/// By Woodbury's identity.
Eigen::MatrixXd OutlineResiduals::products(const Eigen::MatrixXd& columns) const {
  const Eigen::Map<const Eigen::VectorXd> precision(scatter_.precision.data(), columns.rows());
  const Eigen::MatrixXd explained = columns_ * columns;
  return std::exp(-2.0 * scales_.log_noise) * columns.transpose() * precision.asDiagonal() *
             columns -
         explained.transpose() * explained;
}

/// By the noise alone, which the background leaves.
void OutlineResiduals::redraw_growth(const Eigen::VectorXd& noise, Random& random) {
  if (readings_->shares.size() == 0) return;
  const double scale = std::exp(-2.0 * scales_.log_noise);
  const Eigen::Map<const Eigen::ArrayXd> precision(scatter_.precision.data(), noise.size()),
      beforehand(scatter_.beforehand.data(), noise.size());
  const Eigen::ArrayXd shares = (precision > 0.0).select(readings_->shares.array(), 0.0),
                       squares = (precision > 0.0)
                                     .select(scale * noise.array().square() / beforehand, 0.0);
  const auto log_density = [&](double growth) {
    return log_growth_density(growth) - growth * shares.sum() -
           0.5 * (squares * (-2.0 * growth * shares).exp()).sum();
  };
  const double before = scales_.growth;
  for (const double step : kGrowthSteps) {
    const double growth = scales_.growth + step * random.normal();
    if (std::log(random.uniform()) < log_density(growth) - log_density(scales_.growth))
      scales_.growth = growth;
  }
  if (scales_.growth == before) return;
  grow(scatter_, scales_.growth * readings_->shares);
  information_ = information_of(terms(), scatter_.variance);
}

void OutlineResiduals::factor() {
  const Told told = this->told();
  const Marginal marginal = marginal_of(told, scales_);
  columns_.resize(marginal.sd.size(), static_cast<Eigen::Index>(off_.size()));
  if (!terms().is_none()) {
    const double scale = std::exp(-2.0 * scales_.log_noise);
    const Eigen::Map<const Eigen::VectorXd> precision(scatter_.precision.data(), columns_.cols());
    columns_ = marginal.sd.asDiagonal() * terms().of_readings.transpose() *
               (scale * precision).asDiagonal();
    marginal.precision.matrixL().solveInPlace(columns_);
  }
  pull_ = columns_ * Eigen::Map<const Eigen::VectorXd>(off_.data(), columns_.cols());
  change_ = {};
  change_.pull = Eigen::VectorXd::Zero(pull_.size());
}

}  // namespace palpation
