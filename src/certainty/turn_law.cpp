#include "certainty/turn_law.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "base/normal.h"

namespace palpation {
namespace {

/// Of the turn of a piece of a millimetre on a circle of 4 mm, the least radius of small tumours.
constexpr double kBend = 0.25;
constexpr double kCornersOfSmooth = 0.1;  ///< of the bends
constexpr double kCornersOfAngular = 0.4;
constexpr double kCornerBend = 2.5;  ///< half width of Cauchy's law of theirs

constexpr int kTurns = 96;
constexpr double kLeast = -7.0, kStep = 0.25;  ///< of log half widths that are tabulated
constexpr int kTabulated = 41;
constexpr int kMostSteps = 200;
constexpr double kSettled = 1e-9;

using Complex = std::complex<double>;

/// Largest eigenvalue of a kernel, by powers.
double largest_eigenvalue(const Eigen::MatrixXcd& kernel) {
  Eigen::VectorXcd vector = Eigen::VectorXcd::Ones(kernel.rows());
  double value = 0.0;
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::VectorXcd next = kernel * vector;
    const double before = value;
    value = std::real(vector.conjugate().dot(next) / vector.conjugate().dot(vector));
    vector = next / next.norm();
    if (std::abs(value - before) < kSettled * std::abs(value)) break;
  }
  return value;
}

/// With turns as Cauchy's law has them equally likely.
TurnLaw calculated(const Turns& of) {
  const double half_width = std::exp(of.log_half_width),
               most = std::atan(std::numbers::pi / half_width);
  Eigen::VectorXd turns(kTurns);
  for (int i = 0; i < kTurns; ++i)
    turns[i] = half_width * std::tan(most * ((2.0 * i + 1.0) / kTurns - 1.0));
  const double each = 2.0 * most / (std::numbers::pi * kTurns);
  Eigen::MatrixXcd kernel(kTurns, kTurns), turned(kTurns, kTurns);
  for (int i = 0; i < kTurns; ++i) {
    for (int j = 0; j < kTurns; ++j) {
      kernel(i, j) = each * std::exp(log_bend_density(turns[i] - turns[j], of));
      turned(i, j) = kernel(i, j) * std::exp(Complex(0.0, 0.5 * (turns[i] + turns[j])));
    }
  }
  const double all = largest_eigenvalue(kernel);
  // A normal sum's mean cosine is exp(-variance / 2).
  return {std::log(all), -2.0 * std::log(largest_eigenvalue(turned) / all)};
}

using Table = std::array<TurnLaw, kTabulated>;

Table table_of(Bends bends) {
  Table all;
  for (int i = 0; i < kTabulated; ++i) all[i] = calculated({kLeast + kStep * i, bends});
  return all;
}

const Table& table(Bends bends) {
  static const Table smooth = table_of(Bends::Smooth), angular = table_of(Bends::Angular);
  return bends == Bends::Smooth ? smooth : angular;
}

}  // namespace

double log_turn_density(double off, const Turns& turns) {
  const double half_widths = off * std::exp(-turns.log_half_width);
  return -std::log1p(half_widths * half_widths) - turns.log_half_width;
}

double log_bend_density(double differ, const Turns& turns) {
  const double corners = turns.bends == Bends::Smooth ? kCornersOfSmooth : kCornersOfAngular,
               corner = differ / kCornerBend;
  return std::log((1.0 - corners) * std::exp(-half_square(differ / kBend)) +
                  corners / (1.0 + corner * corner));
}

TurnLaw turn_law(const Turns& turns) {
  const double place = std::clamp((turns.log_half_width - kLeast) / kStep, 0.0, kTabulated - 1.001);
  const int below = static_cast<int>(place);
  const double part = place - below;
  const TurnLaw &some = table(turns.bends)[below], &others = table(turns.bends)[below + 1];
  return {std::lerp(some.log_share, others.log_share, part),
          std::exp(std::lerp(std::log(some.variance), std::log(others.variance), part))};
}

}  // namespace palpation
