/// How a closed line's direction turns from piece to piece.
///
/// Turns are off an even one by t_i, and
///
///     p(t_1 ... t_n) = 1 / Z  prod_i C(t_i) B(t_i+1 - t_i),
///
/// C Cauchy's law of some half width, up to half a turn: corners and horns are as likely as its
/// tails make them; B of how unlike the turn is from one node to the next, over how it is where it
/// stays, but for a factor: normal, by as much as the line begins or ends to curve, which is
/// learned, and far wider, as where a corner begins or ends, six times as often in an angular line
/// as in a smooth one. Without B lines between readings would wander as the corners elsewhere have
/// them turn. Z is the trace of K^n, K(t, t') = (C(t) C(t'))^(1/2) B(t - t'), of a dozen nodes and
/// more its largest eigenvalue to the n. That half a turn is the most of an even turn and t_i
/// together is neglected.
#pragma once

#include <cmath>

namespace palpation {

enum class LineKind { Smooth, Angular };
struct Turns {
  double log_half_width = 0.0;  ///< of C, radians
  LineKind kind = LineKind::Angular;
  double log_bend = std::log(0.1);  ///< of B's normal part, radians
};

/// C and B of such turns, but for a constant each; what they have in common is calculated once.
class TurnDensity {
 public:
  explicit TurnDensity(const Turns& turns);

  /// C at a turn that is off so much, radians.
  double at(double off) const { return 1.0 / (half_width_ + off * off / half_width_); }
  /// B where two turns in a row differ by so much.
  double of_bend(double differ) const {
    const double square = differ * differ;
    return std::exp(square * of_bends_) + corners_ / (1.0 + square * of_corners_);
  }

 private:
  double half_width_, of_bends_, of_corners_;
  double corners_;  ///< as high as these stand over bends
};

/// Of lines of such turns.
struct TurnLaw {
  double log_share = 0.0;  ///< each node's, of log Z
  double variance = 0.0;   ///< each turn's, of the sum of a dozen and more, which is nearly normal
};
TurnLaw turn_law(const Turns& turns);

}  // namespace palpation
