/// How much each reading scatters, over the noise's scale, which all have in common.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace palpation {

/// Of the logarithm by which the noise's standard deviation is larger on a plateau than beside it,
/// beforehand, but for a constant: half a Cauchy law, half within a tenth more and one in twenty
/// beyond three times, up to ten times: healthy readings that are all alike tell of no noise. Less
/// noise on a tumour is no sensor's; healthy tissue would seem to make it, where it is uneven.
double log_growth_density(double growth);

struct ReadingScatter {
  std::vector<double> beforehand;  ///< variance
  std::vector<double> variance;    ///< the same, with what noise has grown by
  std::vector<double> precision;   ///< one over that; 0 where a reading tells nothing
};
/// All tell.
ReadingScatter scatter_of(const std::vector<double>& variance);
/// `log_sd`: what it has grown by, of each reading.
void grow(ReadingScatter& scatter, const Eigen::VectorXd& log_sd);

}  // namespace palpation
