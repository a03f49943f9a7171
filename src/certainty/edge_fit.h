/// Laplace's approximation of a boundary's correction and its profile, from the readings.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "palpation/certainty/edge_belief.h"

namespace palpation {

/// low, high, log slope.
using ProfileParameters = Eigen::Vector3d;
using ProfileSlopes = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// A reading's derivatives by the correction at its place, and by the profile's parameters.
struct ReadingSlopes {
  double by_depth = 0.0;
  ProfileParameters by_profile = ProfileParameters::Zero();
};

double profile_share(const ProfileParameters& profile, double depth_m);
double profile_reading(const ProfileParameters& profile, double depth_m);
ReadingSlopes profile_slopes(const ProfileParameters& profile, double depth_m);

/// The readings, one per place.
struct EdgeData {
  std::vector<SurfacePoint> places;
  Eigen::VectorXd reading;
  Eigen::VectorXd variance;               ///< of the noise
  Eigen::VectorXd depth_m;                ///< from the first boundary
  std::vector<std::vector<int>> batches;  ///< that the readings of each were made in
};

struct ProfilePrior {
  ProfileParameters mean = ProfileParameters::Zero();
  Eigen::Vector3d variance = Eigen::Vector3d::Ones();
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
  Eigen::LLT<Eigen::MatrixXd> covariance;
  double scatter = 1.0;  ///< what the noise variances were multiplied by
  double log_evidence =
      0.0;  ///< of the linearized readings, without what depends on their number alone
};

/// `prior_covariance`: K, of the corrections at the places. Throws NumericalError if C is not
/// positive definite.
EdgeFit fit_edge_belief(const EdgeData& data, const Eigen::MatrixXd& prior_covariance,
                        const ProfilePrior& prior);

}  // namespace palpation
