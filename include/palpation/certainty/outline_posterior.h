/// The boundary as a set of outlines, drawn from all that the readings and a wide prior leave open.
///
/// An EdgeBelief knows the boundary as a line with normal errors. Its outlines are all alike; a
/// corner that was not touched, a horn, a neck lie farther out than it knows. Here outlines are
/// sampled: polygons with a profile across their edge (equation 4 of Garg et al. 2016), by Markov
/// chain Monte Carlo, from a prior in which corners are likely (certainty/outline_model.h). What is
/// concluded are figures of the draws: no constant was fitted to any tumour.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "palpation/belief/belief.h"
#include "palpation/belief/level.h"
#include "palpation/certainty/edge_belief.h"
#include "palpation/certainty/expected_error.h"
#include "palpation/certainty/misfit.h"

namespace palpation {

/// What adds to readings and was seen beside the edge; what is left of it is among the unknown.
struct SeenBackground {
  std::optional<WaveScale> slow_waves{};  ///< that are taken back in the readings
  LastingErrors errors_in_turn{};         ///< of the readings as they were made
  /// What of these was taken from each reading in turn: outlines are given it back, since a drift
  /// that was found beside one edge would speak for that edge. Empty where nothing was.
  Eigen::VectorXd drift{};
};

struct OutlineOptions {
  double fraction = 0.5;      ///< of the way from the low plateau to the high one
  double noise_log_sd = 0.0;  ///< of the belief's noise, as EdgeBelief::around has it
  std::uint64_t seed = 1;
  int draws = 200;
  /// The belief's readings, where it knows some of them together: across an edge a mean of two is
  /// not what lies between them. Empty where it knows each.
  std::vector<Palpation> one_by_one{};
  /// What changed while one touched and is taken back in the belief's readings, in time; what is
  /// left of it is among the unknown.
  std::vector<Misfit> changes{};
  SeenBackground background{};
};

/// An expectation, and what holds 95 % of the draws.
struct DrawnNumber {
  double mean = 0.0;
  double least = 0.0;
  double most = 0.0;
};

/// Of a change of zero or gain once it was taken back.
struct ChangeLeft {
  Misfit change;
  Level step;        ///< of the readings since, in the belief's units
  DrawnNumber gain;  ///< by which what stands out does so since
};

/// Of a tumour of two heights what stands out the most; the outline holds what lies beside it, too.
struct DrawnCore {
  SurfacePoint where;   ///< its middle
  DrawnNumber area_m2;  ///< within the outline
  DrawnNumber beside;   ///< contrast beside it, over its own
  /// Within outlines that have a core, and that have none, on average; 0 where all have.
  double with_m2 = 0.0, without_m2 = 0.0;
  /// That there is one: its share of the draws. At most a half where the readings do not tell
  /// (certainty/outline_core_start.h): then all that is concluded is of both kinds.
  double probability = 1.0;
};

/// Readings that were made elsewhere than they are said to be, each by a way of its own, and by one
/// that lasts over some of them, in the order in which they were made: tissue that breathes, a
/// calibration that drifts.
struct WanderingPlaces {
  DrawnNumber way_m;    ///< root mean square over the readings
  DrawnNumber lasting;  ///< part of the ways' variance, by their scales, that lasts
  /// How many were made before that whose way is the longest, on average over the draws.
  std::size_t farthest = 0;
  double farthest_m = 0.0;

  static constexpr double kMatters_m = 0.00025;  ///< a quarter of an outline's piece
  /// Whether that is more than can matter to an outline, on average, and surely.
  bool may_matter() const { return way_m.mean > kMatters_m; }
  bool is_sure() const { return way_m.least > kMatters_m; }
};

/// What speaks against the draws, and against where readings were made.
struct OutlineMisfit {
  /// Between the chains' mean depths along the outline that they began with, over their draws'
  /// standard deviation: above 1 they have not come to the same answer, and the draws say too
  /// little.
  double disagreement = 0.0;
  /// Where readings lie that tell nothing in more than half of the draws.
  std::vector<SurfacePoint> unheeded{};
  /// Where readings tell that places wander, by more than can matter: the draws know it.
  std::optional<WanderingPlaces> wandering{};

  bool do_agree() const { return disagreement < 1.0; }
};

struct OutlinePosterior {
  Field depth;   ///< at the vertices, metres, positive inside: the median of the draws', so that it
                 ///< is positive where a place is inside in more than half of them
  Field spread;  ///< of the draws' depths at the vertices and beside them, metres: by the fourth
                 ///< moment, over a normal law's, so that it is a standard deviation of that
  std::vector<double> farthest;  ///< of each draw, rising: how many `spread` its outline reaches
                                 ///< from the other chain's boundary where it is farthest from it
  ExpectedError expected;        ///< of the region { depth >= 0 }: the mean over the draws
  DrawnNumber area_m2;
  std::vector<ChangeLeft> left;  ///< of OutlineOptions::changes, those of zero and gain
  double noise = 1.0;            ///< standard deviation, over the belief's: the draws' mean
  DrawnNumber noise_inside;      ///< standard deviation on the tumour, over that beside it
  Level level;                   ///< at the boundary of the largest part, in the belief's units
  /// Where the readings lie on two plateaus within one part. `level` is the core's then.
  std::optional<DrawnCore> core{};
  /// That the largest part levels off: reaches nine tenths half way to where it is deepest.
  double plateau_probability = 1.0;
  OutlineMisfit misfit{};

  /// A draw lies wholly within { |depth| <= score spread } with this probability. Throws
  /// InvalidInput unless it lies in (0, 1).
  double band_score(double probability) const;

  /// Whether it surely has a core; or whether, where the readings do not tell, that makes more of a
  /// difference to its area than is expected to be wrong in any case.
  bool core_matters() const;
};

/// From the edge's boundary on. Depends on the arguments alone: readings in another order are the
/// same readings. Nothing where the surface has no chart, which the outlines lie in, or the edge
/// has no boundary. Throws InvalidInput for a fraction outside (0, 1) and fewer than twenty draws.
std::optional<OutlinePosterior> sample_outlines(const Belief& belief, const EdgeBelief& edge,
                                                const OutlineOptions& options = {});

}  // namespace palpation
