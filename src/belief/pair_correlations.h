/// The correlations of sites with each other and their derivatives by the length, at one length after another.
#pragma once

#include <Eigen/Core>
#include <span>

#include "palpation/belief/prior.h"
#include "palpation/belief/sites.h"

namespace palpation {

class PairCorrelations {
 public:
  /// Keeps a reference to the prior.
  PairCorrelations(const Prior& prior, std::span<const Site> sites);

  /// The family is the prior's.
  void set_length(double length_m);

  using Square = Eigen::Map<const Eigen::MatrixXd>;
  Square value() const { return Square(value_.data(), count_, count_); }  ///< all with all
  Square slope() const { return Square(slope_.data(), count_, count_); }  ///< d value / d log(length)

 private:
  void of_distances(const Kernel& kernel);
  void of_differences(const Kernel& kernel);
  void of_modes(const Kernel& kernel);

  const Prior& prior_;
  Eigen::Index count_;
  Eigen::MatrixXd modes_;  // sites x modes, in the intrinsic metric; in the others:
  Eigen::Matrix3Xd coordinates_;
  Eigen::ArrayXd squares_;        // of the distances of all with all, in whole tiles
  Eigen::ArrayXd value_, slope_;  // in whole tiles
};

}  // namespace palpation
