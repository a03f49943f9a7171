/// Whether healthy tissue slopes or waves, weighed against tissue that does not, and a zero that
/// moves.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "exploration/as_if_unchanged.h"

namespace palpation {

/// What readings say, their sessions' and the sensor's zeros taken back.
using KnownOf = std::function<Known(const std::vector<Palpation>& palpations)>;

/// Readings whose background is taken from them, the first of all that is, and by how much more
/// probable it makes them, nats: its freedom is paid for.
struct WithoutBackground {
  Known known;
  double gain = 0.0;
};

/// Of the readings by the edge, or where there is none as noise alone.
double log_evidence_of(const Known& known);
/// The same; an edge that is no more probable than noise alone is dropped.
double log_evidence_or_drop(Known& known);

/// Without the likeliest slope: the freedom to choose it is Schwarz's, of two numbers.
std::optional<WithoutBackground> without_tilt(const Surface& surface,
                                              const std::vector<Palpation>& felt, const Known& flat,
                                              const KnownOf& known_of);

/// Without slow waves that the readings have beside an edge (EdgeBelief::in_slow_waves), which is
/// found without waves, or without those that two parallel surfaces share (waves.h): of texture and
/// waves, which may be there in both, more probable than `simpler`. Nothing where no such surfaces
/// are likelier than level ones, or the sensor's zero moves.
std::optional<WithoutBackground> without_waves(const Surface& surface,
                                               const std::vector<Palpation>& felt,
                                               const Known& flat, const Known& simpler,
                                               const KnownOf& known_of);

/// What is known of readings `felt` without their slope or slow waves; `flat`, with them, where
/// none makes the readings more probable by more than chance does. They are asked for where the
/// level is at the edge, and the field has noise and no trend of its own. Where `is_last` a step of
/// the zero half way through a raster, which looks like either, is asked for beside them.
Known without_background(const Surface& surface, const Model& model,
                         const std::vector<Palpation>& felt, Known flat, const KnownOf& known_of,
                         bool is_last);

}  // namespace palpation
