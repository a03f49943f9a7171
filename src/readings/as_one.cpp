#include "readings/as_one.h"

#include <cmath>

namespace palpation {
namespace {

constexpr double kAlike = 2.0;  // standard deviations of a difference of two

}  // namespace

double variance_of(const Palpation& palpation, double noise_variance) {
  return std::isnan(palpation.noise_variance) ? noise_variance : palpation.noise_variance;
}

bool are_alike(const Palpation& some, const Palpation& others, double noise_variance) {
  return std::abs(others.reading - some.reading) <=
         kAlike *
             std::sqrt(variance_of(some, noise_variance) + variance_of(others, noise_variance));
}

AsOne as_one(const Surface& surface, std::span<const Palpation> together, double noise_variance) {
  const Palpation& first = together.front();
  const Vec3 start = surface.position(first.where);
  AsOne one{first, Vec3::Zero()};
  double precision = 0.0, offset = 0.0;
  for (const Palpation& palpation : together) {
    const double weight = 1.0 / variance_of(palpation, noise_variance);
    precision += weight;
    offset += weight * (palpation.reading - first.reading);
    one.shift_m += weight * (surface.position(palpation.where) - start);
  }
  one.shift_m /= precision;
  one.palpation.reading = first.reading + offset / precision;
  one.palpation.noise_variance = 1.0 / precision;
  return one;
}

}  // namespace palpation
