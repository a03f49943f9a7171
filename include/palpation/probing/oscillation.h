/// Stiffness from a slide: the probe travels over the tissue while a small force oscillates along
/// the normal, and the ratio of force to displacement at that frequency is the stiffness.
///
/// A window of whole periods travels along. In it, by least squares, a cubic in time takes drift
/// and travel, and cosines and sines at the frequency and twice and three times it take the
/// oscillation: complex amplitudes f of the force and x of the position along the axis. The axis is
/// the log's normal or, where it has none, the direction in which the force oscillates most.
/// Reading: the elastic part, Re(f conj(x)) / |x|^2, with the sign of the whole log.
///
/// Noise: with K = f / x, what is left of force less K times what is left of position, at the
/// neighbouring frequencies m / window beside the oscillation: the spectral density there, of
/// whatever colour the noise is, and of stiffness that changes within the window, with what the
/// least squares take of it put back. Its mean over 4 M degrees of freedom (M neighbours to either
/// side, as many as half the periods) gives the variance by Student's t, as in fit_contact. Windows
/// that overlap share noise: their variances are larger by the overlap, so that all together are
/// worth what the samples are.
///
/// No reading comes of a window with a gap or too few samples, without an oscillation that stands
/// out of the noise, with a force that is stuck, or with contact lost in part of the cycle (the
/// force's second and third harmonics, less K times those of the position, above a fifth of the
/// first).
#pragma once

#include <optional>

#include "palpation/probing/robot_log.h"

namespace palpation {

struct OscillationOptions {
  double frequency_hz = 0.0;  ///< 0: found
  int window_periods = 4;     ///< at least 4
  int step_periods = 4;       ///< from one window to the next, at least 1
};

/// What oscillates in force and position both, strongest first, Hz: one, where it is clear;
/// harmonics are no others. Power stands out ten times over the median an octave to either side, so
/// that travel and drift, strong as they are, are background. Empty if nothing stands out.
std::vector<double> oscillations_in(const RobotLog& log);

/// One result a window, in the order of time; the place is the probe's mean position. The log's
/// samples must be in the order of time, each stamp finite: see in_order_of_time. Readings are in
/// the force's unit per millimetre. Throws InvalidInput without times, positions or forces, for
/// options out of range, and where no frequency is given and none, or more than one, stands out.
ProbedLog slide_readings(const RobotLog& log, const OscillationOptions& options = {});

}  // namespace palpation
