/// Ask and tell: where to touch next, given all that was felt so far.
///
///     Exploration exploration(tissue, model, plan);
///     while (const auto stops = exploration.next(); !stops.empty())
///     exploration.record(touch_all(stops));
///
/// The library never owns the robot's loop. `next` does not change anything: asked again, it
/// answers the same until something is recorded.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "palpation/belief/hyperparameters.h"
#include "palpation/belief/lag.h"
#include "palpation/belief/level.h"
#include "palpation/certainty/certainty.h"
#include "palpation/certainty/edge_belief.h"
#include "palpation/exploration/model.h"
#include "palpation/exploration/plan.h"

namespace palpation {

/// The boundary is where the field, one value per vertex, reaches the level.
struct Contour {
  Field field;
  double level = 0.0;
};

class Exploration {
 public:
  /// Throws InvalidInput as Prior, BeliefOptions and the checks of model and plan say.
  explicit Exploration(Surface surface, Model model = {}, Plan plan = {}, Reach reach = {});

  /// The next stops, in the order of travel from where the probe was last: first the initial
  /// design, then batches. Empty when finished.
  std::vector<int> next() const;

  /// For the time while the robot moves: does the work for the stops of next() that no reading
  /// changes, so that after record() the next plan follows at once if all of them were touched, in
  /// this order, and nothing on the way. Changes no answer. Only where the field grows by what is
  /// felt (Economy::rebuild_gain), or nothing of it is learned, nothing set aside and no trend
  /// modelled; else it does nothing.
  void foresee();

  /// What was felt, at stops and on the way. Stops of the last next() that are not among them gave
  /// no contact and are no candidates any more.
  void record(std::span<const Palpation> palpations);

  /// Takes up readings that were made elsewhere or before: nothing is concluded from planned stops
  /// that are not among them.
  void take_up(std::span<const Palpation> palpations);

  /// Why next() is empty: "budget", "expected error", "band", "nothing to gain", "nothing left to
  /// touch"; empty while it is not.
  const std::string& stop_reason() const { return stop_reason_; }

  const Surface& surface() const { return surface_; }
  const Model& model() const { return model_; }
  /// What was recorded, as it was made; with the reason where it was set aside.
  const std::vector<Palpation>& palpations() const { return palpations_; }
  /// Knows the same readings, where a lag is modelled at the places where they belong, and those on
  /// the way that are next to each other as one.
  const Belief& belief() const { return belief_; }
  /// The whole field: its variance is what touches are planned by.
  const Marginals& marginals() const { return marginals_; }
  /// What level and boundary are of: the mean without the slope, with the variance of the whole
  /// field; equal to marginals() where no trend is modelled. The variance without the slope would
  /// count as unsure what level and slope trade between them: it overstates the error.
  const Marginals& component() const { return component_; }
  /// The level as it is estimated now; nothing before the readings show contrast, nor while they
  /// are all alike, unless it is known: the range of noise is no level.
  const std::optional<Level>& level() const { return level_; }
  /// What is known of the boundary in depths; nothing unless the level is inferred from its edge,
  /// and one is seen.
  const std::optional<EdgeBelief>& edge() const { return edge_; }
  /// The boundary: of the depth where edge() knows it, of the component else. Throws InvalidInput
  /// where there is no level.
  Contour contour() const;
  /// A boundary was felt, but it is nowhere wider than the probe's tip: what is left of it once the
  /// tip is taken back is nothing.
  bool tip_hides_all() const;
  /// How sure the boundary is, its band with the model's probability;
  /// nothing where there is no level or no reading.
  const std::optional<Certainty>& certainty() const { return certainty_; }
  /// Area too far from any reading for the boundary's depth to tell (certainty.h), m2; 0 where
  /// edge() is nothing.
  double untouched_m2() const { return untouched_m2_; }
  /// What the next batch maximizes, at the vertices.
  Field acquisition_field() const;
  int batch() const {
    return batch_;
  }  ///< how many batches were recorded, the initial one included
  bool contrast_seen() const { return contrast_seen_; }
  /// A reading that lies farther from all others than they from each other (lone_reading), the
  /// trend apart: what it alone shows is no contrast, and where the others show some and it lies
  /// ten times as far out, it is set aside (kStandsAlone).
  const std::optional<Palpation>& lone_reading() const { return lone_reading_; }
  bool is_screened() const { return model_.field.probe.screening; }
  /// Whether a trend is modelled, but too few places are touched yet to tell a tumour from a tilt.
  bool trend_is_missing() const;
  /// The lag in use; nothing where none is modelled, or it is to be learned and no reading tells.
  const std::optional<Lag>& lag() const { return lag_; }

 private:
  void learn_from(std::span<const Palpation> palpations);
  double believe(std::span<const Palpation> all, std::span<const Palpation> fresh);
  bool shows_contrast(std::span<const Palpation> all, double evidence) const;
  void judge_contrast(std::vector<Palpation>& all, double evidence);
  void weigh_for_heavy_tails(std::span<const Palpation> palpations);
  void estimate_boundary();
  void doubt_where_contact_fades();
  std::vector<int> chosen_stops() const;
  std::vector<int> searching_stops() const;
  Belief searching_belief() const;
  std::vector<int> with_others(std::vector<int> stops, Belief believed, BatchOptions options) const;
  void plan_next();
  std::string reason_to_stop() const;
  Acquisition acquisition_in_force() const;
  std::vector<int> in_tour_order(std::vector<int> stops) const;
  std::vector<int> candidates() const;
  std::vector<Palpation> suppositions(const Belief& belief, std::span<const int> stops,
                                      const BatchOptions& options) const;

  Surface surface_;
  Model model_;
  Plan plan_;
  std::vector<bool> reachable_;
  bool touch_once_;

  std::vector<Palpation> recorded_;    // as it came
  std::vector<Palpation> palpations_;  // screened
  Belief belief_;
  Marginals marginals_;
  Marginals component_;
  std::optional<Level> level_;
  std::optional<EdgeBelief> edge_;
  std::optional<Certainty> certainty_;
  double untouched_m2_ = 0.0;
  std::vector<double> expected_errors_m2_;  // after each batch with a level
  Hyperparameters learned_;
  std::optional<Lag> lag_;
  bool contrast_seen_ = false;
  std::optional<Palpation> lone_reading_;
  int batch_ = 0;
  std::optional<SurfacePoint> probe_;
  std::vector<int> next_;
  std::string stop_reason_;
};

/// A touch: what the probe felt, or nothing where there was no contact. `travel` is the unit
/// direction of travel, or zero; a reading that was made in another direction says so.
using Probe =
    std::function<std::optional<Palpation>(const SurfacePoint& where, const Vec3& travel)>;

/// Touches the stops in order, starting from where the last batch ended, and on the way every
/// way_step_m (0: stops only).
struct Tour {
  std::vector<Palpation> palpations;  ///< in order
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
