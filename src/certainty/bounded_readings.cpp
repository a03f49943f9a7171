#include "certainty/bounded_readings.h"

#include <cmath>

#include "base/normal.h"

namespace palpation {
namespace {

/// From here on a normal tail is an exponential one, to a thousandth.
constexpr double kFar = 30.0;

}  // namespace

double normal_beyond(double least, Random& random) {
  const double part = 1.0 - random.uniform();
  if (least > kFar) return least - std::log(part) / least;
  return -normal_quantile(part * normal_probability(-least));
}

bool ToldAtEnd::allows(double felt_off) const { return sign() * (felt_off - off) >= 0.0; }

double ToldAtEnd::probability(double about, double sd) const {
  return normal_probability(-steps_from(about, sd));
}

double ToldAtEnd::drawn(double about, double sd, Random& random) const {
  return about + sign() * sd * normal_beyond(steps_from(about, sd), random);
}

}  // namespace palpation
