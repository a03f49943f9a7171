/// A contact model's basis at a contact depth, and its least squares: the linear half of the fit.
#pragma once

#include <Eigen/Core>

#include "palpation/probing/indentation.h"

namespace palpation {

/// Samples of one loading, finite, in the order in which they were recorded.
struct Loading {
  Eigen::VectorXd depth_m, force, time_s;
};

/// F statistic by which a bend explains more than none: by chance, one in a thousand.
inline constexpr double kBend = 12.0;

/// Which unknowns a fit has besides the model's own: the sensor's zero, its drift, the contact
/// depth.
struct Unknowns {
  bool zero = true;
  bool drift = false;
  bool contact = false;
};

struct LinearFit {
  Eigen::VectorXd coefficients;  ///< zero, drift, then the model's own
  double squares = 0.0;          ///< sum of squared residuals
  Eigen::VectorXd residuals;
};

/// How many columns of the basis come before the model's own.
int before_own(const Unknowns& unknowns);

/// With the contact depth held.
LinearFit fit_at(const Loading& loading, const ContactOptions& options, const Unknowns& unknowns,
                 double contact_depth_m);

/// The contact depth between two at which the squares are least: the best of a grid, then golden
/// section.
double best_contact(const Loading& loading, const ContactOptions& options, const Unknowns& unknowns,
                    double least_m, double most_m);

/// The value and its variance for residuals of variance one, by the derivatives at the fit; NaN
/// variance where the unknowns cannot be told apart.
struct Value {
  double value = 0.0;
  double unit_variance = 0.0;
};
Value value_of(const Loading& loading, const ContactOptions& options, const Unknowns& unknowns,
               double contact_depth_m, const LinearFit& fit);

/// By which part of its own force each sample's fit moves, the contact depth moving, too.
Eigen::VectorXd leverages_of(const Loading& loading, const ContactOptions& options,
                             const Unknowns& unknowns, double contact_depth_m,
                             const LinearFit& fit);

int unknown_count(const ContactOptions& options, const Unknowns& unknowns);

}  // namespace palpation
