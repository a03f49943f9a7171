/// The boundary as a belief of its own: how deep each place lies inside it, in metres.
///
/// A stationary field knows nothing of plateaus, so it is unsure everywhere and smooths the edge.
/// What readings tell of the edge is clearer in depths. With d(x) the signed distance from a first
/// boundary (positive inside), across the edge
///
///     depth(x) = d(x) + c(x),      c ~ GP(0, correction_sd^2 Matern of the correction length),
///     reading  = low + (high - low) / (1 + exp(-slope depth)) + noise (equation 4 of Garg et al.
///     2016)
///
/// and c, low, high and log slope are found together, with their covariance: Laplace's
/// approximation at the most probable values, by Gauss and Newton's steps. So the level's
/// uncertainty is part of the depth's. Outlines are smooth (Matern 5/2) or have corners (3/2, and a
/// shorter length): both are fitted, and weighed by how probable they make the readings; how sure
/// the boundary is takes both for as likely, since a corner is seen only where it is touched. The
/// boundary lies where the reading is `fraction` of the way
/// from low to high: there the depth handed out is zero.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "palpation/belief/belief.h"
#include "palpation/certainty/edge_profile.h"
#include "palpation/certainty/misfit.h"

namespace palpation {

struct OwnPart;  // certainty/own_parts.h

/// What is known of a boundary's shape beforehand.
struct ShapePrior {
  double correction_sd_m =
      0.001;  ///< how far off the first boundary may be: a millimetre is most of an edge's width
  double correction_length_m = 0.009;  ///< over which it is off the same way: the least radius of
                                       ///< curvature of tumours of a few cm2
  double corner_length_m = 0.006;      ///< the same of outlines with corners
  double slope_per_m = 1200.0;         ///< median of the edge's steepness ...
  double slope_log_sd = 0.5;           ///< ... and the spread of its logarithm
  double own_contrast_sd = 0.5;        ///< of a part beside the strongest, of its contrast
  /// Of the range of the readings' mean: edges are no perfect sigmoids, and readings without noise
  /// still scatter by so much about the profile.
  double profile_error = 0.01;
};

/// In nats, what freedom to lie where it fits costs a loop of such a length: Schwarz's half log of
/// the number of readings for each stretch that it bends over, no fewer than a circle's three.
double price_of_loop(double length_m, const ShapePrior& shape, std::size_t readings);

/// What is not known of a noise that `readings` readings taught: the standard deviation of the
/// logarithm of its own, 1 / sqrt(2 readings).
double learned_noise_log_sd(int readings);

/// A part of the boundary's inside, by its contrast.
struct PartContrast {
  SurfacePoint where;         ///< its highest place
  double of_strongest = 1.0;  ///< contrast, of that of the strongest part
  double stddev = 0.0;        ///< of that; 0: taken for the same
};

struct EdgeOdds {
  double log_odds = 0.0;
  double wave_length_m = 0.0;  ///< of the likeliest waves without an edge; 0: noise explains more
  LastingErrors errors{};  ///< that explain the most without an edge, where these were asked for
};

/// An edge in healthy tissue that waves slowly.
struct EdgeInWaves {
  /// Of the readings, nats: the mean over waves and texture of any height.
  double log_evidence = 0.0;
  double log_evidence_level = 0.0;         ///< with texture alone
  double log_evidence_without_edge = 0.0;  ///< by texture and waves alone
  WaveScale scale{};                       ///< of the likeliest slow waves
  Field waves{};                           ///< their mean, at the vertices: the edge takes its part
};

/// An edge beside errors that last over some readings. There may be none.
struct EdgeInErrors {
  double log_evidence = 0.0;             ///< of the readings, nats, by the likeliest errors
  double log_evidence_in_texture = 0.0;  ///< by the likeliest texture of the tissue instead
  double log_evidence_without_edge = 0.0;
  LastingErrors errors{};  ///< beside the edge, where they make it clearly more probable
  LastingErrors errors_without_edge{};  ///< and
  bool do_last_without_edge = false;    ///< whether noise of as much is less probable by far
  /// Their mean at each reading, in the order in which these were made: the edge takes its part.
  Eigen::VectorXd drift{};
};

class EdgeBelief {
 public:
  /// Around the boundary { mean = first_level } of the belief's field, for the first level that
  /// makes the readings most probable. `component`: what the level cuts, at the vertices (the
  /// field, or the detrended one). Nothing where no boundary can be drawn at any of them, or no
  /// reading is left to place it. Throws InvalidInput for a fraction outside (0, 1), NumericalError
  /// if the readings' covariance is not positive definite. `noise_log_sd`: how unsure the belief's
  /// noise is, which was learned; 0, known.
  static std::optional<EdgeBelief> around(const Belief& belief, const Marginals& component,
                                          std::span<const double> first_levels, double fraction,
                                          const ShapePrior& shape = {}, double noise_log_sd = 0.0);

  /// Depth at the vertices in metres, zero at the boundary. Farther from the first boundary than
  /// any correction reaches it is the distance.
  const Field& depth() const { return depth_; }
  const EdgeProfile& profile() const { return profile_; }
  /// Between low and high, with its standard deviation.
  const Level& level() const { return profile_.level; }
  /// Where some part has a contrast of its own, all parts, the strongest first: the boundary of
  /// each is at `fraction` of its own way. Empty where one contrast explains all.
  const std::vector<PartContrast>& parts() const { return parts_; }
  /// Of a reading, as they scatter about the profile: more than the belief's where the edge is no
  /// sigmoid; less where the noise was learned with a field that could not follow the edge.
  double noise_variance() const { return noise_variance_; }

  /// Of the readings, by noise as large as they scatter about the profile, less what the outline's
  /// freedom costs: compares with that of another belief of as many.
  double log_evidence() const;
  /// By how much more probable the readings are with this edge than without one, with healthy
  /// tissue that waves over 8 mm or more in both. Waves and noise are as probable as they can be
  /// made, and the outline's freedom has its price. `taken_back`: waves that the readings are
  /// without (with_changes_taken_back), at the vertices; with them, they are weighed.
  EdgeOdds odds_over_waves(const Field& taken_back = {}) const;
  /// How probable this edge makes the readings, waves that were taken back included, where tissue
  /// waves over 40 mm or more: compares as log_evidence does. Noise is as probable as it can be
  /// made.
  EdgeInWaves in_slow_waves(const Field& taken_back = {}) const;
  /// The same of errors that last over some readings. `taken_back`: of each reading, in the order
  /// in which they were made, that it is without; zeros where nothing was taken from them.
  EdgeInErrors in_lasting_errors(const Eigen::VectorXd& taken_back) const;

  /// Standard deviation of the boundary's offset, in metres, at the vertices: of the depth where
  /// the boundary comes nearest.
  const Field& offset_sd() const { return offset_sd_; }
  /// Expected area between the boundary and the true one: the integral along it of the offset's
  /// mean absolute value, sqrt(2 / pi) sd.
  double expected_error_m2() const { return expected_error_m2_; }
  /// How many standard deviations the true boundary stays within, all along, with the given
  /// probability: by Rice's formula for the upcrossings of a Gaussian process, from the offsets'
  /// correlation along the boundary, the noise integrated out; widened for tails that are heavier
  /// than a normal's.
  double band_score(double probability) const;

  /// Where touches would tell the most: one after the other, the candidate whose reading lowers the
  /// depth's expected error along the boundary (the integral of its standard deviation) the most,
  /// with what the picks before it will tell. Touches on the plateaus, which earn the level, are
  /// among them when they are worth it. Of candidates within a tenth of the best, the one where the
  /// field is known least (`field_variance`, at the vertices): what tells as much of the edge may
  /// as well tell of the rest.
  std::vector<int> most_telling(std::span<const int> candidates, int count, double least_spacing_m,
                                const Field& field_variance) const;

  /// What of the readings this boundary and its profile do not explain (misfit.h): what surprises,
  /// each kind once, and parts that are too weak to be cut out; the strongest first.
  /// `false_alarms`: the share of runs in which a true model may be doubted, all kinds together.
  /// Throws InvalidInput unless it lies in (0, 1).
  std::vector<Misfit> misfits(double false_alarms = 0.03) const;
  /// Readings that have an outline of their own since some moment (Outline), whatever their zero
  /// and gain: another correction, of the same prior. A session's first moment, where there are
  /// several; else each tenth of all. What is left of zeros and gains that were `taken_back`
  /// explains as much as it can. Nothing where that does not surprise. Throws as `misfits` does.
  std::optional<Misfit> outline_since(std::span<const Misfit> taken_back = {},
                                      double false_alarms = 0.03) const;
  /// How late readings come, to first order, surprising or not (Late). Nothing where nobody knows
  /// from where the probe came.
  std::optional<Misfit> lag() const;
  /// Of what may stand out beside the boundary, surprising or not, that which readings make the
  /// most probable (WeakerPart, its own evidence against none): where to look again. Nothing where
  /// they speak for none.
  std::optional<Misfit> stands_out_most() const;

 private:
  struct Fit;
  struct Task;
  struct AsFelt;
  explicit EdgeBelief(Surface surface);
  static std::optional<EdgeBelief> fitted(const Task& task, const std::vector<OwnPart>& parts,
                                          double low);
  static EdgeBelief either(EdgeBelief one, EdgeBelief other);
  std::vector<OwnPart> parts_apart(const Field& field) const;
  std::vector<OwnPart> told_apart(std::vector<OwnPart> parts, std::vector<Misfit>& weaker) const;
  void name_parts(const std::vector<OwnPart>& parts);
  void mix();
  void survey_boundary();
  const Fit& most_likely() const { return *fits_.front(); }
  double price() const;

  Surface surface_;
  std::vector<std::shared_ptr<const Fit>> fits_;  // the most likely first
  std::vector<PartContrast> parts_;
  std::vector<Misfit> weaker_;  // what stands out by too little to be cut out
  double noise_variance_ = 0.0;
  EdgeProfile profile_;
  Field depth_;
  Field offset_sd_;
  double expected_error_m2_ = 0.0;
  double noise_log_sd_ = 0.0;
  double freedom_ = 0.0;  // what the outline's costs, nats
  double turn_ = 0.0;     // of the standardized offset along the boundary, on the unit sphere
};

}  // namespace palpation
