/// The field after the touches: a Gaussian-process posterior over a surface (Garg et al. 2016,
/// equations 1 and 2).
///
///     K + D = L L',  V = L^-1 K(sites, vertices),  mean = c + V' L^-1 (y - c),  variance =
///     signal^2 (1 - sum V^2) + (what not knowing c adds)
///
/// where K is the matrix of correlations and D the noise of each site over the signal's variance:
/// nothing else is ever added to the diagonal. A constant of unknown value is integrated out
/// (universal kriging), and so is the slope where the prior has one.
///
/// A value: conditioning makes another belief, and copies share what they have in common, so
/// "suppose I touched there" costs what it adds: m more sites over N vertices with n sites known
/// about 2 m n N operations, and 8 m N bytes. Of reduced rank, where that is asked for and enough
/// readings allow it, 2 m M N whatever n is, M < n features; reduced_rank() bounds what is lost.
///
/// Laws: (1) the order of readings does not matter beyond rounding; (2) variance never grows by
/// conditioning, and does not depend on the readings unless they are standardized; (3) variance is
/// that of the field, never containing noise, and never below s / (s + |k|^2) signal^2, s the least
/// noise in D. Without any reading the answer is the prior's: mean 0 (or the constant's mean),
/// variance of the field about its constant.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "palpation/belief/belief_options.h"
#include "palpation/belief/prior.h"
#include "palpation/readings/palpation.h"

namespace palpation {

struct BeliefState;

/// Mean and variance of the field (never of a reading: the noise is not in it), one value per
/// place.
struct Marginals {
  Eigen::VectorXd mean;
  Eigen::VectorXd variance;
};

/// Of the field: all of it, or what is left without the slope, c + g.
enum class Part { Whole, Detrended };

/// Of a belief of reduced rank: how far its mean and its variance at a vertex may be from those of
/// the exact one, reading units and their square, by proof; rounding comes on top.
struct ReducedRank {
  int rank = 0;  ///< features in place of readings
  double mean_error = 0.0;
  double variance_error = 0.0;
};

class Belief {
 public:
  /// Throws InvalidInput unless noise_sd is finite and not negative, and reduced_rank_tolerance 0
  /// or from 1e-13 to 1e-4.
  Belief(Prior prior, const BeliefOptions& options);

  const Prior& prior() const;
  const BeliefOptions& options() const;
  const std::vector<Palpation>& palpations() const;
  /// Places touched; one that is touched again later may count again.
  int site_count() const;
  /// Nothing where the belief is exact.
  std::optional<ReducedRank> reduced_rank() const;

  /// The belief after more touches. Throws InvalidInput naming the palpation whose reading is not
  /// finite or whose variance negative or infinite, or readings of one place that contradict each
  /// other without noise; NumericalError naming the site and its pivot where K + D is not positive
  /// definite in double precision (two sites all but coincide, without noise).
  Belief condition_on(std::span<const Palpation> more) const;

  /// The same belief, with the work done that touches at these places will need and that no reading
  /// changes, for while the robot moves: condition_on is quick if the next touches are those, in
  /// this order, with the field's own noise, and not slower if they are not. What it answers is the
  /// same. Nothing is prepared where a place comes twice among them, or noise is a part of what
  /// readings teach.
  Belief foresee(std::span<const SurfacePoint> places) const;

  Marginals at_vertices(Part part = Part::Whole) const;
  Marginals at(std::span<const SurfacePoint> points, Part part = Part::Whole) const;

  /// Posterior mean of the slope, reading units per metre along each coordinate of the metric.
  Vec3 slope() const;
  /// The palpations less the mean slope at their places: readings of c + g. The same where the
  /// prior has no slope.
  std::vector<Palpation> detrended_palpations() const;
  /// The same of others, in the belief's units.
  std::vector<Palpation> detrended(std::vector<Palpation> palpations) const;

  /// Log density of the readings, the slope integrated out; restricted to what does not depend on
  /// the constant where that is unknown (REML, without the term log|H'H|/2).
  double log_marginal_likelihood() const;

  /// The noise variance of a reading whose own is not given, reading units squared.
  double noise_variance() const;
  /// The field's prior standard deviation in reading units.
  double signal_sd() const;

  /// What its folder sees of it.
  const BeliefState& state() const { return *state_; }

 private:
  explicit Belief(std::shared_ptr<const BeliefState> state) : state_(std::move(state)) {}

  std::shared_ptr<const BeliefState> state_;
};

/// What `Belief(prior, options).condition_on(palpations)` says at the vertices, without keeping
/// anything of the size of sites times vertices: for a belief that is asked only once.
Marginals marginals_once(const Prior& prior, const BeliefOptions& options,
                         std::span<const Palpation> palpations, Part part = Part::Whole);

}  // namespace palpation
