/// Ask and tell: where to touch next, given all that was felt so far.
///
///     Exploration exploration(tissue, model, plan);
///     while (const auto stops = exploration.next(); !stops.empty())
///       exploration.record(touch_all(stops));
///
/// The library never owns the robot's loop. `next` does not change anything: asked again, it
/// answers the same until something is recorded. All that is known follows from the readings, which
/// carry their batch and kind: recorded one batch after the other, or taken up from a file at once,
/// they lead to the same conclusion and the same next stops, to the bit.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "palpation/exploration/choice.h"
#include "palpation/exploration/conclusion.h"
#include "palpation/exploration/model.h"
#include "palpation/exploration/plan.h"

namespace palpation {

class Exploration {
 public:
  /// Throws InvalidInput as `conclude` and `choose` say.
  /// With `outlines_seed` the plan's expected error and band are reasons to stop only where
  /// outlines that are drawn (outline_posterior.h) keep them, too: asked after every batch,
  /// Laplace's approximation is believed when it is luckiest.
  explicit Exploration(Surface surface, Model model = {}, Plan plan = {}, Reach reach = {},
                       std::optional<std::uint64_t> outlines_seed = std::nullopt);

  /// The next stops, in the order of travel from where the probe was last: first the initial
  /// design, then batches. Empty when finished.
  const std::vector<int>& next() const { return choice_.stops; }
  /// Why next() is empty (Choice::stop_reason).
  const std::string& stop_reason() const { return choice_.stop_reason; }
  const Choice& choice() const { return choice_; }

  /// What was felt, at stops and on the way. Stops of the last next() that are not among them gave
  /// no contact and are no candidates any more. A reading's batch is this one, if it does not name
  /// a later one. Throws as `conclude` and `choose`; then nothing was recorded.
  void record(std::span<const Palpation> palpations);

  /// Takes up readings that were made elsewhere or before: nothing is concluded from planned stops
  /// that are not among them. Throws as record.
  void take_up(std::span<const Palpation> palpations);

  /// Concludes from the same readings once more, the boundary's outlines drawn: what the end of a
  /// run may take its time for. The next stops stay as they are, and what is recorded later is
  /// concluded from as before. Throws as `conclude`; then nothing has changed.
  void draw_outlines(std::uint64_t seed);

  /// For the time while the robot moves: does the work for the stops of next() that no reading
  /// changes, so that after record() the next plan follows at once if all of them were touched, in
  /// this order, and nothing on the way. Only where the field grows by what is felt
  /// (Economy::rebuild_gain), or nothing of it is learned, nothing set aside and no trend modelled;
  /// else it does nothing. Means and variances are those without, to rounding.
  void foresee();

  const Surface& surface() const { return surface_; }
  const Plan& plan() const { return plan_; }
  const Reach& reach() const { return reach_; }
  /// All that follows from the readings.
  const Conclusion& conclusion() const { return conclusion_; }
  /// All readings in the order in which they came, those that could not be made too; with the
  /// reason where one is set aside.
  std::vector<Palpation> readings() const;
  /// How many batches were made, the initial one included.
  int batch() const { return progress_.batches; }

 private:
  void learn_from(std::span<const Palpation> fresh);

  Surface surface_;
  Plan plan_;
  Reach reach_;
  std::optional<std::uint64_t> outlines_seed_;
  std::vector<Palpation> readings_;  // as they came
  ConclusionCache cache_;
  Conclusion conclusion_;
  Progress progress_;
  Choice choice_;
  std::optional<Conclusion> drawn_;  // from all readings, where a stop rule asked for it
};

/// A touch: what the probe felt, or nothing where there was no contact. `travel` is the unit
/// direction of travel, or zero; a reading that was made in another direction says so.
using Probe =
    std::function<std::optional<Palpation>(const SurfacePoint& where, const Vec3& travel)>;

/// Touches the stops in order, starting from where the last batch ended, and on the way every
/// way_step_m (0: stops only).
struct Tour {
  std::vector<Palpation> palpations;  ///< in order; stops without contact as missed ones
  std::vector<SurfacePoint> way;      ///< the places between the stops, one per mm
  std::vector<int>
      legs;  ///< for each of these, which of the stops it leads to: its place among them
  double length_m = 0.0;
};
Tour travel(const Surface& surface, std::span<const int> stops,
            const std::optional<SurfacePoint>& from, const Probe& probe, double way_step_m);

/// The whole loop: asks, touches, records, until the exploration is finished. `after_batch` is
/// called after every record.
void run(Exploration& exploration, const Probe& probe,
         const std::function<void(const Tour&)>& after_batch = {}, double way_step_m = 0.0);

}  // namespace palpation
