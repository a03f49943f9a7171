/// An outline and its profile that walk through their posterior, by Metropolis' steps.
///
/// What a step may change is known beforehand: only the pieces that move, and the readings for
/// which one of those is or becomes the nearest. The others keep their likelihood, so that a step
/// costs a few readings, not all.
#pragma once

#include <utility>
#include <vector>

#include "certainty/outline_cut.h"
#include "certainty/outline_model.h"
#include "certainty/outline_pieces.h"
#include "palpation/base/random.h"

namespace palpation {

class OutlineChain {
 public:
  /// The readings and the prior must outlive it. The start's lines must not cross. `residuals`:
  /// whose scales it has.
  OutlineChain(const OutlineReadings& readings, const OutlinePrior& prior, OutlineNodes start,
               OutlineProfile profile, const OutlineCuts& cuts = {},
               const OutlineResiduals* residuals = nullptr);

  /// Proposes that consecutive nodes of a loop, from `first` on, move to these places; at most all
  /// of them. `log_volume`: of the proposal's Jacobian. Never lets lines cross. Returns whether it
  /// was taken.
  bool move_nodes(int first, const std::vector<Vec2>& places, Random& random,
                  double log_volume = 0.0);
  /// Proposes another profile of the same noise; `is_of_shape` where it differs in turns and
  /// log_spacing alone, else it must differ in the others alone.
  bool move_profile(const OutlineProfile& profile, bool is_of_shape, Random& random);

  /// Proposes that it is as steep on all sides, or that it leans somehow.
  bool switch_lean(Random& random);

  /// Proposes that all nodes move to these places and the slope is another, whatever the plateaus:
  /// those are integrated out, and drawn anew from what they are given all else, whether the step
  /// was taken or not. `log_volume` as move_nodes has it.
  bool move_whatever_plateaus(const std::vector<Vec2>& places, double log_slope, Random& random,
                              double log_volume);

  /// Proposes that readings after a change were made elsewhere.
  bool move_tissue(int change, const Vec2& moved_m, Random& random);

  /// The same, and that all nodes move to these places, by the proposal as likely as back.
  bool move_tissue_and_nodes(int change, const Vec2& moved_m, const std::vector<Vec2>& places,
                             Random& random);

  /// Proposes that a reading's own way differs by so much, over the scale of such ways.
  bool wander(std::size_t reading, const Vec2& by, Random& random);
  /// The same of a term of ways that last.
  bool wander_lasting(Eigen::Index term, const Vec2& by, Random& random);
  /// Proposes that places wander so far, and all nodes move to these places, by the proposal as
  /// likely as back.
  bool wander_with_nodes(const Wandering& wandering, const std::vector<Vec2>& places,
                         Random& random);

  /// Other ways that last, by which places lie where they do.
  void redraw_lasting_ways(Random& random);
  /// Proposes another scale of a kind of ways, by which places lie where they do.
  bool rescale_ways(Wandering::Ways Wandering::*kind, double log_growth, Random& random);

  /// Another noise, background and other readings that tell nothing, from what they are given all
  /// else. Returns the zero's steps, drawn with them.
  Eigen::VectorXd redraw_residuals(Random& random, bool keeps_telling);

  /// Proposes that a cut which is present is not, or that a fresh one is.
  bool switch_cut(int which, Random& random);
  /// Proposes that a present cut has another form, as likely as back; its anchor may differ.
  bool move_cut(int which, const OutlineCut& cut, Random& random);
  /// Makes any of the readings within its radius of its middle its anchor.
  void anchor_anew(int which, Random& random);

  const OutlineNodes& outline() const { return outline_; }
  const OutlineCuts& cuts() const { return taken_.cuts; }
  const OutlineProfile& profile() const { return profile_; }
  const OutlinePrior& prior() const { return *prior_; }
  const ReadingLaw& law() const { return law_; }
  const OutlineResiduals& residuals() const { return residuals_; }
  /// Of the readings, the plateaus integrated out, without what depends on nothing that moves.
  double log_evidence() const;
  /// Of the posterior, without what depends on nothing that moves.
  double log_density() const;

 private:
  /// Where a reading lies to the outline.
  struct Felt {
    Vec2 place = Vec2::Zero();  ///< where it was made, as far as that is known
    NearestPiece nearest;
    bool inside = false;
    double depth_m = 0.0;  ///< in the loops, less what cuts take
    double share = 0.0;    ///< of its contrast
  };
  struct Step;
  struct Plateaus;

  int epoch_of(std::size_t reading) const;
  Vec2 place_of(std::size_t reading) const;
  int part_of(const Felt& felt) const;
  double depth_of(const Felt& felt) const;
  /// Of its part's contrast, for where the core is.
  double share_of_contrast(const Felt& felt, const ReadingLaw& law) const;
  double share_of(const Felt& felt, const ReadingLaw& law) const;
  double off_from(std::size_t reading, const Felt& felt, const ReadingLaw& law) const;
  Felt felt_anew(const Vec2& place) const;
  Felt felt_at(const Vec2& place, NearestPiece nearest, bool inside) const;
  std::vector<Felt> felt_at_start();
  OutlineResiduals fresh_residuals() const;
  double log_prior() const;
  /// Of the loop that holds it: is the outer line of the part, or the hole, that it lies in; -1 if
  /// none does.
  int holder_of(const Felt& felt) const;
  std::vector<int> held_in(const std::vector<Felt>& felt) const;
  bool may_hold(const std::vector<int>& held) const;
  bool is_nested_as_before() const;
  bool may_swallow(const Step& step) const;
  Plateaus plateaus() const;
  /// Another thought: nothing is considered.
  void consider_none();
  void consider(std::size_t reading, const Felt& felt, const ReadingLaw& law);
  /// Whether what is considered is taken, where the rest of the log density changes by so much;
  /// makes it so.
  bool takes(double change, Random& random);
  bool feels_elsewhere(const OutlineProfile& profile, const std::vector<Vec2>& places,
                       Random& random);
  bool feels_profile(const OutlineProfile& profile, double change, Random& random);
  bool try_cut(int which, const OutlineCut& cut, double change, Random& random);
  Step step_from(int first, int moved) const;
  double shape_about(const Step& step) const;
  bool feel(Step& step, Random& random);
  bool crosses_another(const Step& step) const;
  bool is_untouched(const Step& step, std::size_t reading) const;
  Felt felt_after(const Step& step, std::size_t reading) const;

  const OutlineReadings* readings_;
  const OutlinePrior* prior_;
  OutlineNodes outline_;
  OutlinePieces pieces_;  // of the outline
  OutlineProfile profile_;
  ReadingLaw law_;  // of the profile
  TakenOut taken_;
  std::vector<Felt> felt_;
  OutlineResiduals residuals_;
  std::vector<bool> nesting_;                        // of the outline's loops
  std::vector<int> held_;                            // readings, by each loop
  std::vector<std::pair<std::size_t, Felt>> fresh_;  // what the step at hand changes
};

}  // namespace palpation
