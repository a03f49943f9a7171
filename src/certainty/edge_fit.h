/// Laplace's approximation of a boundary's correction and its profile, from the readings.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/cholesky.h"
#include "belief/sites.h"
#include "palpation/certainty/edge_belief.h"

namespace palpation {

/// No correction moves a boundary farther than this many of its standard deviations: depths beyond
/// keep their side.
inline constexpr double kReach = 6.0;

/// low, high, log slope; then, for each part but the first, how much higher than high it reaches.
using ProfileParameters = Eigen::VectorXd;
using ProfileSlopes = Eigen::MatrixXd;
inline constexpr Eigen::Index kCommonParameters = 3;

/// A reading's derivatives by the correction at its place, and by the profile's parameters.
struct ReadingSlopes {
  double by_depth = 0.0;
  ProfileParameters by_profile;
};

/// Of the way up, at a depth. Parts count from 0, the one that high is of.
double profile_share(const ProfileParameters& profile, double depth_m);
/// From low to that part's plateau.
double profile_contrast(const ProfileParameters& profile, int part);
double profile_reading(const ProfileParameters& profile, int part, double depth_m);
ReadingSlopes profile_slopes(const ProfileParameters& profile, int part, double depth_m);

/// The readings, one per place.
struct EdgeData {
  std::vector<SurfacePoint> places;
  Eigen::VectorXd reading;
  Eigen::VectorXd variance;             ///< of the noise
  Eigen::VectorXd depth_m;              ///< from the first boundary
  std::vector<int> part;                ///< that each is nearest to
  std::vector<std::vector<Made>> made;  ///< of the readings of each
  /// Log likelihood of what was merged about its means: with it, evidence of data that were merged
  /// otherwise compares. Its squares over the noise variance, and how many of them are free.
  double log_scatter = 0.0, scatter_squares = 0.0, scatter_freedom = 0.0;
};

struct ProfilePrior {
  ProfileParameters mean;
  Eigen::VectorXd variance;
};

/// Readings are linear in corrections and profile around the most probable ones: their covariance
/// is C = J K J' + G S G' + noise, J and G the derivatives by correction and profile, K and S the
/// priors.
struct EdgeFit {
  ProfileParameters profile;
  Eigen::VectorXd correction_m;  ///< at the readings' places
  Eigen::VectorXd by_depth;      ///< J's diagonal
  ProfileSlopes by_profile;      ///< G
  Eigen::VectorXd pull;          ///< C^-1 (linearized readings - their prior mean)
  TiledLlt covariance;
  double scatter = 1.0;  ///< what the noise variances were multiplied by
  double log_evidence =
      0.0;  ///< of the linearized readings, without what depends on their number alone
};

/// `prior_covariance`: K, of the corrections at the places; where its variance is 0 no correction
/// reaches. Throws NumericalError if C is not
/// positive definite.
EdgeFit fit_edge_belief(const EdgeData& data, const Eigen::MatrixXd& prior_covariance,
                        const ProfilePrior& prior);

}  // namespace palpation
