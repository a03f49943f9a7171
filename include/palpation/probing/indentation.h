/// One indentation, from force over depth to what the tissue is there: stiffness and its variance.
///
/// Models, u being how far the probe is past the contact point d0, which is unknown:
///   Linear        F = b + k u                          value k, force unit per metre
///   Hertz         F = b + 4/3 E* sqrt(R) u^(3/2)       value E* = E / (1 - nu^2), force unit per
///   m2;
///                 a rigid sphere of radius R on a half-space, u well below R (K. L. Johnson,
///                 Contact Mechanics, 1985, equation 4.23)
///   ForceAtDepth  F = b + a1 u + a2 u^2                value a1 h + a2 h^2, the force at u = h
/// Least squares over the samples up to the deepest one; what follows (hold, retract) is not used,
/// as tissue relaxes. Where the samples begin in the air (at least five, their force flat, and a
/// bend at d0 that explains the rest) d0 and the sensor's zero b are found with the fit, and so is
/// b's drift where stamps are given. Where they do not, all are taken to be in contact: then the
/// slope of Linear needs neither b nor d0; Hertz takes the sensor as tared (b = 0) and finds d0;
/// ForceAtDepth counts h from the shallowest sample and the force as it is.
///
/// The variance is that of the fit: the residuals' own, s^2 (J'J)^-1 with J the derivative by all
/// unknowns, d0 too, times n / (n - 2) for n degrees of freedom: the variance of Student's t, so
/// that two standard deviations hold about 95 % whatever n. Fewer than three degrees say nothing:
/// NaN. It knows nothing of a model that is wrong beyond what that adds to the residuals, nor,
/// where all samples are in contact, of a sensor that drifts during one press: that looks like
/// stiffness.
///
/// Samples whose force or depth is not finite are left out, as are single ones (a tenth at most)
/// that are spikes: more than 6 robust standard deviations off the fit, or, as one at an end draws
/// the fit to itself, off what the others foretell by what is as rare as 5 standard deviations of a
/// normal (a sample in two million: Student's t of a residual over the standard deviation without
/// it). Also left out: one whose step from its neighbours is 4 times any other, for a fit that
/// looks for the contact could take it for the tissue; and a force that stays the same to the last
/// digit while the probe goes deeper and the fit leaves it (saturated, or the sensor hung).
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>

namespace palpation {

enum class ContactModel { Linear, Hertz, ForceAtDepth };

/// Whether samples begin in the air: looked for, known, or known not to.
enum class Approach { Find, Recorded, NotRecorded };

struct ContactOptions {
  ContactModel model = ContactModel::Linear;
  double indenter_radius_m = 0.0;  ///< of Hertz: it must be given
  double at_depth_m = 0.0;         ///< of ForceAtDepth: it must be given
  int least_samples = 3;           ///< in contact
  Approach approach = Approach::Find;
};

/// In the order in which they were recorded. Depth grows into the tissue, force with pressing.
struct Indentation {
  Eigen::VectorXd depth_m, force;
  Eigen::VectorXd time_s{};  ///< as many, or none
};

/// Why an indentation gives no value.
enum class ContactOutcome {
  Fitted,
  TooFewSamples,
  NoContact,     ///< the force does not rise above its own noise
  NotMonotone,   ///< the depth goes to and fro
  Stuck,         ///< the force stays the same
  NotSoDeep,     ///< of ForceAtDepth: the depth asked for is not reached
  NotDetermined  ///< the samples do not tell the model's unknowns apart
};

struct ContactFit {
  ContactOutcome outcome = ContactOutcome::TooFewSamples;
  std::string reason{};  ///< in words; empty where fitted
  double value = std::numeric_limits<double>::quiet_NaN();
  double variance = std::numeric_limits<double>::quiet_NaN();
  double contact_depth_m = std::numeric_limits<double>::quiet_NaN();  ///< d0
  bool approach_seen = false;  ///< else contact_depth_m is Hertz's, or the shallowest sample's
  double residual_sd = std::numeric_limits<double>::quiet_NaN();
  int samples = 0;   ///< that the fit rests on, those in the air included
  int left_out = 0;  ///< not finite, spikes, saturated
  double held = std::numeric_limits<double>::quiet_NaN();  ///< force of those saturated or stuck
};

/// Throws InvalidInput where the vectors differ in length or an option is out of its range.
ContactFit fit_contact(const Indentation& indentation, const ContactOptions& options = {});

}  // namespace palpation
