#include "certainty/turn_law.h"

#include <Eigen/Eigenvalues>
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
constexpr double kCornersOfSmooth = 0.1;  ///< of B, where a turn stays
constexpr double kCornersOfAngular = 0.4;
constexpr double kCornerBend = 2.5;  ///< half width of Cauchy's law of theirs

constexpr int kTurns = 96;
constexpr int kTogether = 12;  ///< turns whose sum tells their variance
constexpr double kLeastCosine = 1e-3;
constexpr double kLeast = -7.0, kStep = 0.25;  ///< of log half widths that are tabulated
constexpr int kTabulated = 41;

/// By turns as dense as their asinh in half widths is even; a chain of turns whose kernel is K has
/// the square of K's first eigenvector for its law, and K over its eigenvalue steps from one turn
/// to the next. Of a few turns the mean cosine of the sum tells its variance, as far as that
/// matters to where a line ends: tails that go on beyond a radian do not.
TurnLaw calculated(const Turns& of) {
  const double half_width = std::exp(of.log_half_width),
               most = std::asinh(std::numbers::pi / half_width), step = 2.0 * most / kTurns;
  Eigen::VectorXd turns(kTurns), weight(kTurns);
  for (int i = 0; i < kTurns; ++i) {
    const double even = (i + 0.5) * step - most;
    turns[i] = half_width * std::sinh(even);
    weight[i] = step / (std::numbers::pi * std::cosh(even));  // Cauchy's density, by the Jacobian
  }
  Eigen::MatrixXd kernel(kTurns, kTurns);
  for (int i = 0; i < kTurns; ++i) {
    for (int j = 0; j < kTurns; ++j)
      kernel(i, j) = std::sqrt(weight[i] * weight[j]) *
                     std::exp(log_bend_density(turns[i] - turns[j], of.kind));
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(kernel);
  const double largest = eigen.eigenvalues()[kTurns - 1];
  const Eigen::VectorXd law = eigen.eigenvectors().col(kTurns - 1);
  Eigen::VectorXcd phases(kTurns);
  for (int i = 0; i < kTurns; ++i) phases[i] = std::polar(1.0, turns[i]);
  Eigen::VectorXcd turned = phases.cwiseProduct(law);
  for (int i = 1; i < kTogether; ++i)
    turned = phases.cwiseProduct(kernel * turned / largest).eval();
  const double cosine = std::max((law.transpose() * turned).value().real(), kLeastCosine);
  return {std::log(largest), -2.0 * std::log(cosine) / kTogether};
}

using Table = std::array<TurnLaw, kTabulated>;

Table table_of(LineKind kind) {
  Table all;
  for (int i = 0; i < kTabulated; ++i) all[i] = calculated({kLeast + kStep * i, kind});
  return all;
}

const Table& table(LineKind kind) {
  static const Table smooth = table_of(LineKind::Smooth), angular = table_of(LineKind::Angular);
  return kind == LineKind::Smooth ? smooth : angular;
}

}  // namespace

double log_turn_density(double off, const Turns& turns) {
  const double half_widths = off * std::exp(-turns.log_half_width);
  return -std::log1p(half_widths * half_widths) - turns.log_half_width;
}

double log_bend_density(double differ, LineKind kind) {
  const double corners = kind == LineKind::Smooth ? kCornersOfSmooth : kCornersOfAngular,
               corner = differ / kCornerBend;
  return std::log((1.0 - corners) * std::exp(-half_square(differ / kBend)) +
                  corners / (1.0 + corner * corner));
}

TurnLaw turn_law(const Turns& turns) {
  const double place = std::clamp((turns.log_half_width - kLeast) / kStep, 0.0, kTabulated - 1.001);
  const int below = static_cast<int>(place);
  const double part = place - below;
  const TurnLaw &some = table(turns.kind)[below], &others = table(turns.kind)[below + 1];
  return {std::lerp(some.log_share, others.log_share, part),
          std::exp(std::lerp(std::log(some.variance), std::log(others.variance), part))};
}

}  // namespace palpation
