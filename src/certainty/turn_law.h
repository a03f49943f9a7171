/// How a closed line's direction turns from piece to piece.
///
/// Turns are off an even one by t_i, and
///
///     p(t_1 ... t_n) = 1 / Z  prod_i C(t_i) B(t_i+1 - t_i),
///
/// C Cauchy's law of some half width, up to half a turn: corners and horns are as likely as its
/// tails make them; B of bends, how unlike the turn is from one node to the next: mostly as little
/// as where a line begins or ends to curve with a least radius, else as a corner begins or ends:
/// one bend in ten of a smooth line, four in ten of an angular one. Without B lines between
/// readings would wander as the corners elsewhere have them turn. Z is the trace of K^n,
/// K(t, t') = (C(t) C(t'))^(1/2) B(t - t'), for many nodes its largest eigenvalue to the n.
#pragma once

namespace palpation {

enum class Bends { Smooth, Angular };
struct Turns {
  double log_half_width = 0.0;  ///< of C, radians
  Bends bends = Bends::Angular;
};

/// Log of C at a turn that is off so much, radians, but for a constant.
double log_turn_density(double off, const Turns& turns);

/// Log of B, where two turns in a row differ by so much.
double log_bend_density(double differ, const Turns& turns);

/// Of lines of such turns.
struct TurnLaw {
  double log_share = 0.0;  ///< each node's, of log Z
  double variance = 0.0;   ///< each turn's, of the sum of many turns, which is nearly normal
};
TurnLaw turn_law(const Turns& turns);

}  // namespace palpation
