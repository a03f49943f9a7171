/// What readings say that the model of one outline, one profile and one sensor does not.
///
/// Each rival, tissue that moved to first order, adds one term to the readings near their most
/// probable explanation: y = model + h theta, theta normal. With C the readings' covariance and r
/// what is left of them, the rival is weighed against none by its Bayes factor, the noise's scale
/// integrated out,
///
///     (r' C^-1 r / r' (C + h S h')^-1 r)^(n/2) (1 + h' C^-1 h S)^(-1/2),
///
/// and a kind of misfit by the mean over its rivals: when it began, where it lies, what kind of
/// outline there is (edge_belief.h). Were the model true, that mean would exceed 1 / a in a share a
/// of all runs at most (Markov's inequality), so what counts as surprising needs no constant but
/// the rate of false alarms.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "palpation/belief/belief.h"

namespace palpation {

enum class MisfitKind {
  Zero,        ///< readings lie higher or lower from some batch on
  Gain,        ///< from some batch on what stands out does so by more or less
  Moved,       ///< from some batch on the tissue lies elsewhere, or the registration does
  WeakerPart,  ///< something stands out that the outline does not hold
  Tilted,      ///< all readings rise to one side
  Waves,       ///< all readings rise and fall slowly over the tissue
  Drift,       ///< errors last from reading to reading, in the order in which these were made
  Outline,     ///< from some moment on readings have an outline of their own
  Late,        ///< all readings are of places behind, or ahead, along the way (lag.h)
};

/// Of slow waves over tissue.
struct WaveScale {
  double length_m = 0.0;  ///< over which they are alike
  double sd = 0.0;        ///< how high they are, in readings
};

/// Errors that last over some readings, in the order in which these were made.
struct LastingErrors {
  double readings = 0.0;  ///< over so many they are alike; 0: there are none
  double sd = 0.0;        ///< in readings
};

/// What healthy tissue, the way a sensor is held and its drift add to all readings.
struct Unevenness {
  Vec3 slope_per_m = Vec3::Zero();  ///< of Tilted: readings per metre, and
  Vec3 middle = Vec3::Zero();       ///< where it adds nothing
  Field waves{};                    ///< of Waves: at the vertices, in readings
  WaveScale wave_scale{};
  Eigen::VectorXd drift{};  ///< of Drift: of each reading, in the order in which they were made
  LastingErrors errors{};   ///< which the drift is of
};

/// Of a kind, the rival that explains the most.
struct Misfit {
  MisfitKind kind = MisfitKind::Zero;
  double evidence = 0.0;  ///< nats: logarithm of the kind's mean Bayes factor
  int from_batch = 0;     ///< Zero, Gain, Moved, Outline: the first batch that differs
  /// Zero, Gain, Moved, Outline: how many readings were made before the first that differs, those
  /// that the belief takes as one counted apart.
  std::size_t number = 0;
  int session = 0;  ///< the first that differs, where sessions tell; 0: batch and number do
  /// Zero: by how much, in readings. Gain: the factor, less one. Moved: how far, metres.
  /// WeakerPart: its height above the profile there, in readings. Outline: how much deeper that
  /// place lies within it. Late: how far behind. Metres both.
  double amount = 0.0;
  double stddev = 0.0;                  ///< of the amount, where that was estimated
  double rms = 0.0;                     ///< Outline: of the amount, over all that tell of it
  double low = 0.0;                     ///< Gain: what reads so is not changed by it
  Vec3 moved_m = Vec3::Zero();          ///< Moved: where to
  std::optional<SurfacePoint> where{};  ///< WeakerPart; Outline: where it is felt the most
  Unevenness background{};              ///< Tilted, Waves, Drift
};

/// Whether it adds to all readings, all the while: a slope, waves or drift.
bool is_background(const Misfit& change);

/// Whether it changes where readings belong, not what they are: tissue that moved, or a lag.
bool is_displacement(const Misfit& change);

/// Whether it is of all readings, all the while: a background, or readings that come late.
bool is_of_all(const Misfit& change);

/// Whether it was made after that.
bool is_since(const Misfit& change, const Made& made);

/// "zero", "gain", "moved", "weaker", "tilt", "waves", "drift", "outline", "late".
std::string_view name_of(MisfitKind kind);

/// What a kind's evidence must exceed, nats, so that a true model is doubted in so many runs at
/// most, all kinds together. Throws InvalidInput unless that lies in (0, 1).
double surprising(double false_alarms = 0.03);

/// The change since some moment, of place, zero or gain, that makes the field's readings more
/// probable by the most, where it surprises: tissue that moved in its own plane, or whose
/// registration did, by up to 6 mm, a zero that moved by up to a contrast, a gain of half to twice.
/// Each kind is weighed by the mean, over eleven moments and over changes on a grid, all equally
/// likely, of the readings' likelihood over that without a change, by the field that was learned as
/// if there was none. The moment is that of the likeliest change, to a reading where there are no
/// more than 200.
std::optional<Misfit> changed_since(const Belief& belief);

}  // namespace palpation
