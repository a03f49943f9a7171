/// The field after the touches: an exact Gaussian-process posterior over a surface (Garg et al.
/// 2016, equations 1 and 2).
///
///     K + D = L L',  V = L^-1 K(sites, vertices),  mean = c + V' L^-1 (y - c),  variance =
///     signal^2 (1 - sum V^2) + (what not knowing c adds)
///
/// where K is the matrix of correlations and D the noise of each site over the signal's variance:
/// nothing else is ever added to the diagonal. A constant of unknown value is integrated out
/// (universal kriging), and so is the slope where the prior has one:
///
///     mean += E[b].r,  variance += r' Cov[b] r,  r = x - x0 - (X - x0)' L^-T V - a (1 - 1' L^-T
///     V),
///
/// a the change of the constant's mean for a unit of slope. Of c + g alone the same holds with r
/// less x - x0.
///
/// A value: conditioning makes another belief. Copies share the rows of L and V they have in
/// common, which are only ever appended, so "suppose I touched there" costs what it adds: m more
/// sites over N vertices with n sites known cost about 2 m n N floating-point operations, and 8 m N
/// bytes.
///
/// Of reduced rank, where that is asked for: once the readings are so many that M < n features tell
/// the prior apart from itself by no more than a tolerance of its variance at every vertex and
/// every site, readings are taken in by their features f alone (weight_space.h),
///
///     variance = signal^2 (1 - |f|^2 + f' A^-1 f),  A = I + sum f f' / d,
///
/// so that m more cost 2 m M N operations whatever n is. Smooth kernels need few features (for a
/// squared exponential some hundreds over fifteen lengths at 1e-12), rough ones too many, and stay
/// exact. reduced_rank() bounds what is lost: the bound grows like the tolerance over the noise.
/// Readings whose noise is below a hundred thousand tolerances of the signal's variance are not
/// reduced.
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
#include <vector>

#include "palpation/belief/prior.h"
#include "palpation/belief/sites.h"
#include "palpation/readings/palpation.h"

namespace palpation {

struct TileRows;

/// Mean and variance of the field (never of a reading: the noise is not in it), one value per
/// place.
struct Marginals {
  Eigen::VectorXd mean;
  Eigen::VectorXd variance;
};

/// Of the field: all of it, or what is left without the slope, c + g.
enum class Part { Whole, Detrended };

struct BeliefOptions {
  double noise_sd = 0.0;           ///< of a reading whose own variance is not given
  bool noise_is_relative = false;  ///< noise_sd is a fraction of the kernel's signal_sd
  bool standardize = false;  ///< the kernel's signal_sd, the constant's sd and the slope's are
                             ///< multiples of the readings' standard deviation, and the constant's
                             ///< mean is the readings' mean: outputs z-scored, as GPy does
  double reduced_rank_tolerance =
      0.0;  ///< of the prior's variance, the part that may be left out so that many readings cost
            ///< no more than a few hundred (see below); 0: none
  bool single_precision = false;  ///< V is kept in single precision, half as large; all arithmetic
                                  ///< and L stay in double. Mean and variance are off by less than
                                  ///< 1e-4 of the signal's; refused below kLeastNoiseForSingle
};

/// Of a belief of reduced rank.
struct ReducedRank {
  int rank = 0;  ///< features in place of readings
  double mean_error =
      0.0;  ///< from the exact belief at a vertex, reading units: not more than this, by proof ...
  double variance_error = 0.0;  ///< ... nor this, reading units squared. Rounding comes on top
};

/// Noise variance over the signal's, of any reading, below which reduced rank is left aside for the
/// exact belief: so many times BeliefOptions::reduced_rank_tolerance, since the bound on what is
/// lost grows with the tolerance over the noise.
inline constexpr double kLeastNoiseForReducedRank = 1e5;

/// Noise variance over the signal's, of a reading, below which single precision would cost more
/// than it saves.
inline constexpr double kLeastNoiseForSingle = 1e-3;

class Belief {
 public:
  /// Throws InvalidInput unless noise_sd is finite and not negative, and reduced_rank_tolerance 0
  /// or from 1e-13 to 1e-4.
  Belief(Prior prior, const BeliefOptions& options);

  const Prior& prior() const { return prior_; }
  const BeliefOptions& options() const { return options_; }
  const std::vector<Palpation>& palpations() const { return palpations_; }
  /// Places touched; one that is touched again later may count again.
  int site_count() const;
  /// Nothing where the belief is exact.
  std::optional<ReducedRank> reduced_rank() const;

  /// The belief after more touches. Throws as gather_sites and merge, and NumericalError naming the
  /// site and its pivot where K + D is not positive definite in double precision (two sites all but
  /// coincide, without noise).
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

  /// Log density of the readings, the slope integrated out; restricted to what does not depend on
  /// the constant where that is unknown (REML, without the term log|H'H|/2).
  double log_marginal_likelihood() const;

  /// The noise variance of a reading whose own is not given, reading units squared.
  double noise_variance() const;
  /// The field's prior standard deviation in reading units.
  double signal_sd() const;

 private:
  friend class CovarianceWith;
  friend class LookAhead;
  friend Marginals marginals_once(const Prior& prior, const BeliefOptions& options,
                                  std::span<const Palpation> palpations, Part part);
  struct Rows;        // consecutive rows of L and V
  struct Sums;        // over all rows of V at the vertices
  struct Foreseen;    // rows of touches to come
  struct Reduced;     // what stands in the rows' place
  struct Regressors;  // and is fed with
  struct Seen;
  enum class Keep { Rows, Nothing };
  /// With more noise, over the signal's variance, 1 - v'v is good to eleven digits at the site too.
  static constexpr double kSmallNoise = 1e-4;

  int row_count() const;
  Eigen::VectorXd solve_lower(Eigen::VectorXd right_side) const;
  void restate_spread();
  void state_origin(std::span<const Site> sites);
  void restate_sites(std::size_t more);
  void restate_readings();
  void keep_rows(int count);
  void append_rows(Keep keep);
  void append_foreseen();
  void append_to_factor(Rows& fresh);
  void append_to_solutions(const Rows& fresh);
  void append_to_vertices(Rows& fresh, Keep keep);
  Eigen::MatrixXd solution_rows(int first, int count) const;
  int sum_rows() const;
  void restate_constant();
  void restate_slope();
  bool constant_is_unsure() const;
  Vec3 tilt_residual(const Vec3& x, const Vec3& v_tilts, double residual_ones, Part part) const;
  Seen look_at(const Place& place) const;
  void sharpen();

  bool reduce(std::size_t more);
  bool reduce_all();
  bool append_to_reduced(const std::vector<Site>& sites);
  Regressors regressors(std::span<const Site> sites) const;
  void restate_reduced();
  void see_all();
  void see(const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& rows);
  Vec3 tilt_residual_at(int vertex, Part part) const;
  void add_slope(Part part, Marginals& marginals) const;
  std::vector<double> column_of_v(int vertex) const;
  std::vector<TileRows> rows_of_v() const;
  double held(double covariance, int a, int b) const;
  double residual_ones(int vertex) const;

  Prior prior_;
  BeliefOptions options_;
  std::vector<Palpation> palpations_;
  std::vector<Site> sites_;
  int repeat_count_ = 0;          // of them, places that an earlier one has too
  std::vector<double> readings_;  // merged, one per site
  std::vector<double> diagonal_;  // D
  double spread_ = 1.0;           // of the readings, if standardized
  double centre_ = 0.0;           // prior mean of the constant

  std::shared_ptr<const Reduced> reduced_;  // null: exact
  int reduction_tried_at_ = 0;              // sites, in vain

  std::vector<std::shared_ptr<const Rows>> rows_;
  Eigen::VectorXd ones_;      // L^-1 1
  Eigen::VectorXd whitened_;  // L^-1 (y - origin)
  double origin_ = 0.0;
  Field sharp_;  // 1 - sum V^2 with its digits kept, or empty where none are in danger
  std::shared_ptr<const Sums> sums_;  // nothing without a site
  std::shared_ptr<const Foreseen> foreseen_;
  double constant_precision_ =
      0.0;  // posterior precision of c over the signal's; 0: c is not known at all, infinite: known
  double constant_ = 0.0;  // posterior mean of c

  // The slope, in standard deviations of its prior; empty and zero where there is none.
  using Tilts = Eigen::Matrix<double, Eigen::Dynamic, 3>;
  Tilts tilts_;                                                // L^-1 of Prior::tilt at the sites
  Vec3 tilt_ = Vec3::Zero();                                   // posterior mean
  Eigen::Matrix3d tilt_covariance_ = Eigen::Matrix3d::Zero();  // over the signal's variance
  Vec3 constant_per_tilt_ = Vec3::Zero();                      // by how much c falls for each
};

/// What `Belief(prior, options).condition_on(palpations)` says at the vertices, without keeping
/// anything of the size of sites times vertices: for a belief that is asked only once.
Marginals marginals_once(const Prior& prior, const BeliefOptions& options,
                         std::span<const Palpation> palpations, Part part = Part::Whole);

class TileCorrelations;

/// Posterior covariance of the field between one vertex and others: the row that a hypothetical
/// touch there would add.
class CovarianceWith {
 public:
  /// Keeps a reference: the belief must outlive it.
  CovarianceWith(const Belief& belief, int vertex);

  /// With `count` consecutive vertices from `first` on, written to `out`.
  void operator()(int first, int count, double* out) const;

 private:
  const Belief& belief_;
  int vertex_;
  std::shared_ptr<const TileCorrelations> correlations_;
  std::vector<double> column_;        // of V
  double residual_ones_;              // 1 - V' L^-1 1
  Vec3 tilt_weights_ = Vec3::Zero();  // of the slope's residual at the other vertex
};

}  // namespace palpation
