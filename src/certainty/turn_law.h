/// How a closed line's direction turns from piece to piece.
///
/// A line that curves has turns that are off an even one by t_i, and
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
///
/// A polygon curves nowhere: each of its turns is drawn anew,
///
///     p(t) = (1 - c) W(t; side) + c W(t; corner),
///
/// W the wrapped Cauchy law of some half width (Mardia and Jupp 2000, section 3.5.7), a corner's a
/// radian. What curves is as straight as a side nowhere, and turns by and by where a polygon has a
/// corner: of a corner that nobody touched it would be sure that it is round.
#pragma once

#include <cmath>

namespace palpation {

enum class LineKind { Smooth, Angular, Polygonal };
struct Turns {
  double log_half_width = 0.0;  ///< of C, or of W in a side, radians
  LineKind kind = LineKind::Polygonal;
  double log_bend = std::log(0.1);  ///< of B's normal part, radians
};

/// What a turn's density is made of, but for constants that all kinds have; what turns have in
/// common is calculated once.
class TurnDensity {
 public:
  explicit TurnDensity(const Turns& turns);

  /// C, or a polygon's p, at a turn, where an even one is so much, radians.
  double at(double turn, double even) const;
  /// B where two turns in a row differ by so much; a polygon's is 1.
  double of_bend(double differ) const;

 private:
  LineKind kind_;
  double half_width_;
  double of_bends_ = 0.0;     ///< in the exponent, over a difference's square
  double corners_ = 0.0;      ///< as high as these stand over bends
  double side_cosine_ = 0.0;  ///< mean, of a side's turns
};

/// Of lines of such turns.
struct TurnLaw {
  double log_share = 0.0;   ///< each node's, of log Z
  double variance = 0.0;    ///< each turn's, of the sum of a dozen and more, which is nearly normal
  double off_closed = 0.0;  ///< the sum's mean, off what a closed line's is
};
TurnLaw turn_law(const Turns& turns);

}  // namespace palpation
