/// Steps in readings of a field with a constant that is not known.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "palpation/belief/belief.h"
#include "palpation/certainty/misfit.h"

namespace palpation {

class ZeroSteps {
 public:
  /// By the belief's field. `numbers`, rising: of the palpations, those that are looked at, more
  /// than four. Keeps references to both.
  ZeroSteps(const Belief& belief, std::span<const Palpation> palpations,
            std::span<const std::size_t> numbers);

  /// What each of the changes adds, all at once. Of sessions any is as likely.
  std::vector<Misfit> estimated(std::vector<Misfit> changes) const;
  /// One more than these, where it surprises; at a reading that is looked at.
  std::optional<Misfit> another(const std::vector<Misfit>& known) const;
  /// The one that explains most, where it surprises beside no step at all: tissue may have made it,
  /// too, if the ground is another since then, as in a raster.
  std::optional<Misfit> by_zero_or_tissue() const;
  /// The last of these changes, whose amounts are estimated, at the moment that explains best what
  /// was felt between the reading that it was found at and the one that was looked at before.
  Misfit sharpened(const std::vector<Misfit>& changes) const;

 private:
  struct Found;

  Found found_beside(const std::vector<Misfit>& known) const;
  std::optional<Misfit> surprising_at(Eigen::Index first, double evidence) const;
  Eigen::MatrixXd covariance_with(std::span<const SurfacePoint> places) const;
  Eigen::VectorXd in_space(const Eigen::VectorXd& in_time) const;
  Eigen::MatrixXd columns(const std::vector<Misfit>& changes,
                          std::span<const std::size_t> numbers) const;
  Eigen::MatrixXd precision_of(const std::vector<Misfit>& changes,
                               const Eigen::MatrixXd& steps) const;

  std::span<const Palpation> palpations_;
  std::span<const std::size_t> numbers_;
  Prior prior_;
  double variance_;  // of a step
  std::vector<SurfacePoint> places_;
  double middle_ = 0.0;       // of the readings, and
  Eigen::VectorXd readings_;  // what each is off by
  Eigen::MatrixXd inverse_;
  std::vector<std::vector<std::size_t>> neighbours_;
};

}  // namespace palpation
