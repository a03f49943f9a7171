/// What changed while one touched, as far as an edge tells it: a gain, or where the tissue lies.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "exploration/as_if_unchanged.h"

namespace palpation {

/// The gain, move or lag that makes readings the most probable by their edge once it is taken back,
/// by more than chance does. Nothing where a step of the zero would make them more so: what of that
/// can be taken back was.
std::optional<Misfit> change_to_take_back(const Model& model, const Known& known,
                                          const std::vector<Palpation>& readings);

/// A step that readings show in time, and as well on the ground: where that is another since then,
/// tissue may have made it, or the zero.
struct RasterStep {
  Misfit zero{};
  double gain = 0.0;  ///< nats: how much more probable readings are by an edge without it
  /// One that is felt before it and since: what is left of tissue's own step is felt there alone.
  bool leaves_another_edge = false;

  bool is_of_the_zero() const { return leaves_another_edge && gain > surprising(); }
  bool is_of_tissue() const { return gain < -surprising(); }
};
std::optional<RasterStep> raster_step(const Model& model, const Known& known,
                                      const std::vector<Palpation>& readings);

/// A move found by a field, which is too smooth to follow an edge, is off by half a field's length,
/// and its moment by some readings; a lag is known to first order. Uphill from there, by steps that
/// are halved, to how far and since which reading is most probable by the edge of the readings
/// `felt`, all `changes` taken back: across the rows of a raster, where nothing is felt before and
/// since, not at all. `which`: of these, the move or lag.
void look_closer_at(std::size_t which, std::vector<Misfit>& changes, const Surface& surface,
                    const Model& model, const std::vector<Palpation>& felt);

/// misfits(Conclusion), of its edge, its belief, and its readings without what was taken back.
/// Tissue that moved, and a lag, are among them where that makes the outline likelier, too: a
/// smooth field alone takes two readings of healthy tissue for the same place, and a raster for a
/// move.
std::vector<Misfit> misfits_of(const Model& model, const std::optional<EdgeBelief>& edge,
                               const Belief& belief, std::span<const Palpation> readings);

}  // namespace palpation
