/// The correlations of sites with each other and their derivatives by the length, at one length
/// after another.
#pragma once

#include <Eigen/Core>
#include <span>

#include "belief/sites.h"
#include "palpation/belief/prior.h"

namespace palpation {

class PairCorrelations {
 public:
  /// Keeps a reference to the prior.
  PairCorrelations(const Prior& prior, std::span<const Site> sites);

  /// The family is the prior's.
  void set_length(double length_m);

  /// All with all: on the diagonal and below it; nothing is meant by what stands above.
  using Lower = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
  Lower value() const {
    return Lower(value_.data(), count_, count_, Eigen::OuterStride<>(stride_));
  }
  Lower slope() const {
    return Lower(slope_.data(), count_, count_, Eigen::OuterStride<>(stride_));
  }  ///< d value / d log(length)

 private:
  void of_distances(const Kernel& kernel);
  void of_differences(const Kernel& kernel);
  void of_modes(const Kernel& kernel);

  const Prior& prior_;
  Eigen::Index count_, stride_;  // whole tiles a column
  Eigen::MatrixXd modes_;        // sites x modes, in the intrinsic metric; in the others:
  Eigen::Matrix3Xd coordinates_;
  Eigen::ArrayXd squares_;  // of the distances
  Eigen::ArrayXd value_, slope_;
};

}  // namespace palpation
