/// What else may add to readings than the most probable outline does, weighed against nothing
/// (misfit.h).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "base/log_mean.h"
#include "certainty/edge_data.h"
#include "palpation/certainty/edge_profile.h"
#include "palpation/certainty/misfit.h"

namespace palpation {

/// What a rival may add, standard deviations, in units of its column h.
inline constexpr double kPart = 0.5;

/// The readings and their most probable explanation under one kind of outline.
struct ExplainedReadings {
  const Surface& surface;
  const EdgeFit& fit;
  const EdgeData& data;
  double log_weight;  ///< of this kind of outline, against the most likely one's
  double low;
  double contrast;
  Eigen::VectorXd depth;     ///< of each row
  Eigen::VectorXd share;     ///< of the contrast, at that depth
  Eigen::VectorXd residual;  ///< r
  Eigen::VectorXd pull;      ///< C^-1 r
  /// Of what else is known to add to the readings: C^-1 is that of the fit less these times their
  /// transposes.
  std::vector<Eigen::VectorXd> also{};

  ExplainedReadings(const Surface& on, const EdgeFit& edge, const EdgeData& readings,
                    const EdgeProfile& profile, double weight);

  /// C^-1 times a column.
  Eigen::VectorXd solve(const Eigen::VectorXd& column) const;

  /// From here on a rival is known to add to the readings (Sherman and Morrison's identity).
  void add(const Eigen::VectorXd& column);
};

/// A rival with its evidence and amount. `column`: h.
Misfit weighed(const ExplainedReadings& rows, const Eigen::VectorXd& column, Misfit rival);

/// Of each row, the part of its readings that were made after that began.
Eigen::VectorXd part_since(const EdgeData& data, const Misfit& change);

/// Rivals of one kind, in turn.
class RivalKind {
 public:
  /// With its evidence.
  void add(Misfit rival);
  void weigh(const ExplainedReadings& rows, const Eigen::VectorXd& column, Misfit rival);

  /// The strongest one's evidence.
  double strongest() const;

  /// The strongest, with the kind's evidence; nothing without rivals.
  std::optional<Misfit> verdict() const;

 private:
  LogMean factors_;
  std::optional<Misfit> best_;
};

}  // namespace palpation
