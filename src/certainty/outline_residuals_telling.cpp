// Which readings tell, and what those do at the end of the sensor's range.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/normal.h"
#include "certainty/outline_residuals.h"
#include "certainty/wild_readings.h"

namespace palpation {
namespace {

constexpr double kWildBeyond = 0.5;  ///< of what tells nothing, where the sensor's range ends

/// Beta's, of whole numbers: of so many uniform numbers the one of this rank.
double beta_draw(int a, int b, Random& random) {
  std::vector<double> numbers;
  for (int i = 0; i < a + b - 1; ++i) numbers.push_back(random.uniform());
  std::ranges::nth_element(numbers, numbers.begin() + a - 1);
  return numbers[static_cast<std::size_t>(a) - 1];
}

double normal_density(double off, double square) {
  return std::exp(-half_square(off) / square) / std::sqrt(2.0 * std::numbers::pi * square);
}

}  // namespace

ToldAtEnd OutlineResiduals::told_at_end(std::size_t reading) const {
  return {readings_->bounds[reading], told_[reading]};
}

/// Of its noise.
double OutlineResiduals::variance_of(std::size_t reading) const {
  return scatter_.variance[reading] * std::exp(2.0 * scales_.log_noise);
}

/// Of what was told, if it tells and the background leaves this; a probability of what is bounded.
double OutlineResiduals::density(std::size_t reading, double noise) const {
  const double square = variance_of(reading);
  return is_bound(reading)
             ? told_at_end(reading).probability(off_[reading] - noise, std::sqrt(square))
             : normal_density(noise, square);
}

double OutlineResiduals::wild_density(std::size_t reading) const {
  return is_bound(reading) ? kWildBeyond : prior_.wild_density;
}

double OutlineResiduals::mixed_density(std::size_t reading, double telling) const {
  return (1.0 - scales_.wild) * telling + scales_.wild * wild_density(reading);
}

double OutlineResiduals::lacking(std::size_t reading) const {
  const double fitting = is_bound(reading) ? 1.0 : normal_density(0.0, variance_of(reading));
  return std::log(mixed_density(reading, fitting) /
                  mixed_density(reading, density(reading, off_[reading])));
}

std::vector<std::size_t> OutlineResiduals::unheeded() const {
  std::vector<std::size_t> unheeded;
  for (std::size_t i = 0; i < off_.size(); ++i) {
    if (!tells(i)) unheeded.push_back(i);
  }
  return unheeded;
}

/// By the noise alone; and how often readings tell nothing.
void OutlineResiduals::redraw_telling(const Eigen::VectorXd& noise, Random& random) {
  for (std::size_t i = 0; i < off_.size(); ++i) {
    const double mixed = mixed_density(i, density(i, noise[static_cast<Eigen::Index>(i)]));
    const bool tells = random.uniform() * mixed > scales_.wild * wild_density(i);
    scatter_.precision[i] = tells ? 1.0 / scatter_.variance[i] : 0.0;
  }
  const int wild = static_cast<int>(std::ranges::count(scatter_.precision, 0.0)),
            telling = static_cast<int>(scatter_.precision.size()) - wild;
  scales_.wild = beta_draw(kWildBefore + wild, kTellingBefore + telling, random);
}

/// How far each that tells is off, of what is bounded.
void OutlineResiduals::redraw_bounded(const Eigen::VectorXd& noise, Random& random) {
  for (std::size_t i = 0; i < off_.size(); ++i) {
    if (!is_bound(i) || !tells(i)) continue;
    const double about = off_[i] - noise[static_cast<Eigen::Index>(i)];
    off_[i] = told_at_end(i).drawn(about, std::sqrt(variance_of(i)), random);
  }
}

}  // namespace palpation
