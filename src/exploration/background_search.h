/// Whether healthy tissue slopes or waves, or the sensor drifts, weighed against what does not, and
/// a zero that moves.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "exploration/as_if_unchanged.h"

namespace palpation {

/// What readings say, their sessions' and the sensor's zeros taken back.
using KnownOf = std::function<Known(const std::vector<Palpation>& palpations)>;

/// Readings whose background is taken from them, the first of all that is.
struct WithoutBackground {
  Known known;
  double gain = 0.0;  ///< by how much more probable it makes them, nats: its freedom is paid for
};

/// The same of what there may be beside any edge.
struct BesideEdge {
  Known known;
  double log_evidence = 0.0;  ///< with it, comparable by the noise without
};

/// Of the sensor, that were taken back: not of sessions.
bool is_step_of_zero(const Misfit& change);
std::ptrdiff_t steps_of_zero(const Known& known);
/// How many readings do not count.
std::ptrdiff_t set_aside(const Known& known);

/// Of the readings by the edge, or where there is none as noise alone.
double log_evidence_of(const Known& known);
/// The same; an edge that is no more probable than noise alone is dropped.
double log_evidence_or_drop(Known& known);

/// Without the likeliest slope: the freedom to choose it is Schwarz's, of two numbers.
std::optional<WithoutBackground> without_tilt(const Surface& surface,
                                              const std::vector<Palpation>& felt, const Known& flat,
                                              const KnownOf& known_of);

/// Without slow waves that the readings have beside an edge (EdgeBelief::in_slow_waves), which is
/// found without waves, or without those that two parallel surfaces share (waves.h). Nothing where
/// no such surfaces are likelier than level ones, or the sensor's zero moves.
std::optional<BesideEdge> without_waves(const Surface& surface, const std::vector<Palpation>& felt,
                                        const Known& flat, const KnownOf& known_of);

/// With texture, or waves of the slope that was taken back: what without_waves is weighed against.
double log_evidence_in_waves(const Surface& surface, const Known& known, double noise_variance);

/// Without the errors that last from reading to reading beside an edge
/// (EdgeBelief::in_lasting_errors), which is found without them, or without those that two parallel
/// lines share (drift.h). Nothing where such errors are not clearly seen beside the edge.
std::optional<BesideEdge> without_drift(const Surface& surface, const std::vector<Palpation>& felt,
                                        const Known& flat, const KnownOf& known_of);

/// With texture, something else in one place or lasting errors beside an edge, each step of the
/// zero at its price of two numbers: what without_drift is weighed against.
double log_evidence_in_errors(const Known& known, Eigen::Index readings, double noise_variance);

/// What was tried on readings `felt` at any time, not at the end alone.
struct TriedBackgrounds {
  Model model;
  std::vector<Palpation> felt;
  Known flat;  ///< with their background
  std::optional<WithoutBackground> tilted;
  std::optional<BesideEdge> waved;
};

/// They are asked for where the level is at the edge, and the field has noise and no trend of its
/// own.
TriedBackgrounds tried_backgrounds(const Surface& surface, const Model& model,
                                   const std::vector<Palpation>& felt, Known flat,
                                   const KnownOf& known_of);

/// What is known of readings without their slope, slow waves or drift; with them, where none makes
/// the readings more probable by more than chance does. Where `is_last` a drift, and a step of the
/// zero half way through a raster, which look like either, are asked for beside them.
Known without_background(const Surface& surface, const TriedBackgrounds& tried,
                         const KnownOf& known_of, bool is_last);

}  // namespace palpation
