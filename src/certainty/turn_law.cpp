#include "certainty/turn_law.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <mutex>
#include <numbers>
#include <utility>

namespace palpation {
namespace {

/// Bends of corners where a turn stays, over how wide those are that are none: at their median a
/// ninth as high as these, and two thirds.
constexpr double kCornersOfSmooth = 1.1, kCornersOfAngular = 6.7;
constexpr double kCornerBend = 2.5;  ///< half width of Cauchy's law of theirs

/// Of a polygon's nodes, those that are corners; and the half width of their turns.
constexpr double kCorners = 0.1, kOfCorner = 1.0;

constexpr int kTurns = 96;
constexpr int kTogether = 12;  ///< turns whose sum tells their variance
constexpr double kLeastCosine = 1e-3;

/// Of logarithms that are tabulated; what lies beyond is taken for the first and the last.
struct Grid {
  double least, step;
  int count;

  double operator[](int place) const { return least + step * place; }
  double last() const { return (*this)[count - 1]; }
};
constexpr Grid kOfHalfWidths = {-7.0, 0.25, 41}, kOfBends = {-4.0, 0.25, 21};

/// By a turn's cosine, times pi, as C is; of turns whose mean cosine is e to less the half width.
double wrapped_cauchy(double cosine, double mean) {
  const double narrow = 1.0 - mean;
  return 0.5 * narrow * (1.0 + mean) / (narrow * narrow + 2.0 * mean * (1.0 - cosine));
}

const double kCornerCosine = std::exp(-kOfCorner);

double side_cosine(const Turns& turns) { return std::exp(-std::exp(turns.log_half_width)); }

/// Turns do not depend on each other: of sums cosines multiply.
TurnLaw of_polygons(const Turns& turns) {
  const double cosine = std::lerp(side_cosine(turns), kCornerCosine, kCorners);
  return {.variance = -2.0 * std::log(cosine), .off_closed = 2.0 * std::numbers::pi};
}

/// By turns as dense as their asinh in half widths is even; a chain of turns whose kernel is K has
/// the square of K's first eigenvector for its law, and K over its eigenvalue steps from one turn
/// to the next. Of a few turns the mean cosine of the sum tells its variance, as far as that
/// matters to where a line ends: tails that go on beyond a radian do not.
TurnLaw calculated(const Turns& of) {
  const TurnDensity density(of);
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
      kernel(i, j) = std::sqrt(weight[i] * weight[j]) * density.of_bend(turns[i] - turns[j]);
  }
  // Turns to the left are as likely as to the right: half of the first eigenvector is enough.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
      kernel.topLeftCorner(kTurns / 2, kTurns / 2) +
      kernel.topRightCorner(kTurns / 2, kTurns / 2).rowwise().reverse());
  const double largest = eigen.eigenvalues().tail<1>().value();
  const Eigen::VectorXd half = eigen.eigenvectors().rightCols<1>() / std::numbers::sqrt2;
  Eigen::VectorXd law(kTurns);
  law << half, half.reverse();
  Eigen::VectorXcd phases(kTurns);
  for (int i = 0; i < kTurns; ++i) phases[i] = std::polar(1.0, turns[i]);
  Eigen::VectorXcd turned = phases.cwiseProduct(law);
  for (int i = 1; i < kTogether; ++i)
    turned = phases.cwiseProduct(kernel * turned / largest).eval();
  const double cosine = std::max((law.transpose() * turned).value().real(), kLeastCosine);
  return {.log_share = std::log(largest), .variance = -2.0 * std::log(cosine) / kTogether};
}

/// Of one kind, each calculated when it is asked for first.
class TurnTable {
 public:
  explicit TurnTable(LineKind kind) : kind_(kind) {}

  const TurnLaw& at(int half_width, int bend) {
    Cell& cell = cells_[static_cast<std::size_t>(half_width * kOfBends.count + bend)];
    std::call_once(cell.is_known, [&] {
      cell.law = calculated({kOfHalfWidths[half_width], kind_, kOfBends[bend]});
    });
    return cell.law;
  }

 private:
  struct Cell {
    std::once_flag is_known;
    TurnLaw law;
  };
  LineKind kind_;
  std::array<Cell, static_cast<std::size_t>(kOfHalfWidths.count* kOfBends.count)> cells_;
};

TurnTable& table(LineKind kind) {
  static TurnTable smooth(LineKind::Smooth), angular(LineKind::Angular);
  return kind == LineKind::Smooth ? smooth : angular;
}

/// Between which two it lies, and how far from the first.
std::pair<int, double> place_among(const Grid& grid, double number) {
  const double place = std::clamp((number - grid.least) / grid.step, 0.0, grid.count - 1.001);
  const int below = static_cast<int>(place);
  return {below, place - below};
}

TurnLaw between(const TurnLaw& some, const TurnLaw& others, double part) {
  return {
      .log_share = std::lerp(some.log_share, others.log_share, part),
      .variance = std::exp(std::lerp(std::log(some.variance), std::log(others.variance), part))};
}

}  // namespace

TurnDensity::TurnDensity(const Turns& turns)
    : kind_(turns.kind), half_width_(std::exp(turns.log_half_width)) {
  if (kind_ == LineKind::Polygonal) {
    side_cosine_ = side_cosine(turns);
    return;
  }
  const double bend = std::exp(std::clamp(turns.log_bend, kOfBends.least, kOfBends.last()));
  of_bends_ = -0.5 / (bend * bend);
  corners_ = bend * (kind_ == LineKind::Smooth ? kCornersOfSmooth : kCornersOfAngular);
}

double TurnDensity::at(double turn, double even) const {
  if (kind_ == LineKind::Polygonal) {
    const double cosine = std::cos(turn);
    return std::lerp(wrapped_cauchy(cosine, side_cosine_), wrapped_cauchy(cosine, kCornerCosine),
                     kCorners);
  }
  const double off = turn - even;
  return 1.0 / (half_width_ + off * off / half_width_);
}

double TurnDensity::of_bend(double differ) const {
  if (kind_ == LineKind::Polygonal) return 1.0;
  const double square = differ * differ;
  return std::exp(square * of_bends_) + corners_ / (1.0 + square / (kCornerBend * kCornerBend));
}

TurnLaw turn_law(const Turns& turns) {
  if (turns.kind == LineKind::Polygonal) return of_polygons(turns);
  const auto [width, of_width] = place_among(kOfHalfWidths, turns.log_half_width);
  const auto [bend, of_bend] = place_among(kOfBends, turns.log_bend);
  TurnTable& laws = table(turns.kind);
  return between(between(laws.at(width, bend), laws.at(width + 1, bend), of_width),
                 between(laws.at(width, bend + 1), laws.at(width + 1, bend + 1), of_width),
                 of_bend);
}

}  // namespace palpation
