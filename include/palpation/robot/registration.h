/// Where the tissue is, in the robot's frame: from places that the robot touched.
///
/// Paired places (the same landmark in both frames) give the rigid transform in closed form
/// (S. Umeyama, Least-squares estimation of transformation parameters between two point patterns,
/// IEEE Trans. Pattern Anal. Mach. Intell. 13, 1991; without scale). Places anywhere on the tissue
/// refine it: point to surface, as by Y. Chen and G. Medioni, Object modelling by registration of
/// multiple range images, Image Vis. Comput. 10, 1992.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

/// Metres.
struct TouchedPair {
  Vec3 tissue = Vec3::Zero(), robot = Vec3::Zero();
};

using Covariance6 = Eigen::Matrix<double, 6, 6>;

struct Registration {
  Eigen::Matrix4d from_tissue = Eigen::Matrix4d::Identity();  ///< p_robot = from_tissue p_tissue
  std::vector<double> residuals_m{};  ///< of each place: its distance, or, refined, that from the
                                      ///< surface
  double rms_m = 0.0;
  /// Of a small turn (rad) about `centre` and a shift (m), in the robot's frame.
  Covariance6 covariance = Covariance6::Zero();
  Vec3 centre = Vec3::Zero();  ///< of the places, in the robot's frame
};

/// `touch_sd_m`: how well a place is touched, at best; the residuals may say that it was worse.
/// Throws InvalidInput for fewer than three pairs; places that are not finite, or all on one line
/// or in one spot (to a millimetre beside it); two sets of different size, such as millimetres and
/// metres, or mirrored.
Registration register_pairs(std::span<const TouchedPair> pairs, double touch_sd_m = 0.0002);

/// From a first guess, by touched places alone, in the robot's frame. Throws InvalidInput for fewer
/// than six, for places more than 10 mm from the surface, and where they do not hold the tissue in
/// place, as on a plane, a sphere or a cylinder; NumericalError where it does not come to rest.
Registration refine_on_surface(const Surface& surface, std::span<const Vec3> touched,
                               const Registration& guess, double touch_sd_m = 0.0002);

/// How far, with 95 %, the tissue may lie along its normal from where it is taken to be: at the
/// vertex where that is most.
double uncertainty_along_normal_m(const Surface& surface, const Registration& registration);
/// And along itself, in the direction where that is most: how far all that is felt may lie off, the
/// same way.
double uncertainty_along_surface_m(const Surface& surface, const Registration& registration);

}  // namespace palpation
