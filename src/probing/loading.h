/// The samples of an indentation that its fit rests on: finite, on the way in, the force alive.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "palpation/probing/indentation.h"
#include "probing/contact_model.h"

namespace palpation {

double range_of(const Eigen::VectorXd& values);
Loading rows_of(const Loading& loading, const std::vector<Eigen::Index>& rows);

/// The loading without single samples far off the fit; nothing where there are none.
std::optional<Loading> without_spikes(const Loading& loading, const Eigen::VectorXd& residuals);

/// The loading without the one sample that its fit can least be, if the others say that clearly: a
/// spike at an end draws the fit to itself, so that no residual shows it.
std::optional<Loading> without_misfit(const Loading& loading, const Eigen::VectorXd& residuals,
                                      const Eigen::VectorXd& leverages, int unknowns);

/// A fit that is none.
ContactFit failed(ContactOutcome outcome, const std::string& reason, int left_out);

/// The loading to fit, or why there is none.
struct Prepared {
  Loading loading{};
  std::optional<ContactFit> fault{};
  int left_out = 0;
  double held = std::numeric_limits<double>::quiet_NaN();  ///< as ContactFit's
};
Prepared prepare(const Indentation& indentation, const ContactOptions& options);

}  // namespace palpation
