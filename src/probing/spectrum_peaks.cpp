// The oscillation that was put on a slide, found in the spectra of force and position.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "palpation/probing/oscillation.h"
#include "probing/log_samples.h"
#include "probing/robust.h"

namespace palpation {
namespace {

constexpr Eigen::Index kBlock = 512;       // samples: 30 to 500 periods of what can be found
constexpr double kGap = 5.5;               // sampling steps
constexpr double kStandsOut = 10.0;        // times the median around
constexpr double kRival = 0.25;            // of the strongest: then a person has to say
constexpr Eigen::Index kLowestBin = 4;     // periods a block: drift lies below
constexpr double kSamplesPerPeriod = 6.0;  // at least: the third harmonic has two

/// Columns of force and position side by side, evenly in time, their line taken off and windowed.
Eigen::MatrixXd block_at(const RobotLog& log, const Eigen::MatrixXd& columns, Eigen::Index first,
                         double step_s) {
  Eigen::MatrixXd block(kBlock, columns.cols());
  Eigen::Index before = first;
  for (Eigen::Index i = 0; i < kBlock; ++i) {
    const double time_s = log.time_s[first] + static_cast<double>(i) * step_s;
    while (before + 2 < log.size() && log.time_s[before + 1] < time_s) ++before;
    const double span_s = log.time_s[before + 1] - log.time_s[before];
    const double share =
        span_s > 0.0 ? std::clamp((time_s - log.time_s[before]) / span_s, 0.0, 1.0) : 0.0;
    block.row(i) = (1.0 - share) * columns.row(before) + share * columns.row(before + 1);
  }
  const Eigen::RowVectorXd start = block.row(0),
                           slope = (block.row(kBlock - 1) - start) / double(kBlock - 1);
  for (Eigen::Index i = 0; i < kBlock; ++i) {
    const double hann = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * double(i) / double(kBlock));
    block.row(i) = hann * (block.row(i) - start - double(i) * slope);
  }
  return block;
}

/// Power of each column at each whole number of periods a block.
Eigen::MatrixXd powers_of(const Eigen::MatrixXd& block, Eigen::Index bins) {
  Eigen::MatrixXd powers(bins, block.cols());
  for (Eigen::Index bin = 0; bin < bins; ++bin) {
    Eigen::VectorXcd wave(kBlock);
    for (Eigen::Index i = 0; i < kBlock; ++i)
      wave[i] = std::polar(1.0, -2.0 * std::numbers::pi * double(i * bin % kBlock) / kBlock);
    powers.row(bin) = (wave.transpose() * block).cwiseAbs2();
  }
  return powers;
}

/// How far a bin's power stands out of the median an octave to either side.
double over_surroundings(const Eigen::VectorXd& power, Eigen::Index bin) {
  const Eigen::Index low = std::max<Eigen::Index>(kLowestBin / 2, bin / 2),
                     high = std::min<Eigen::Index>(power.size() - 1, 2 * bin);
  const double around = median_of({power.data() + low, power.data() + high + 1});
  return around > 0.0 ? power[bin] / around : 0.0;
}

/// Of peaks, by bin: force and position both have to stand out.
std::vector<double> prominence_of(const Eigen::MatrixXd& sums) {
  std::vector<double> prominence(static_cast<std::size_t>(sums.rows()), 0.0);
  const Eigen::VectorXd together = sums.rowwise().prod();
  for (Eigen::Index bin = kLowestBin; bin + 1 < sums.rows(); ++bin) {
    if (together[bin] < together[bin - 1] || together[bin] <= together[bin + 1]) continue;
    prominence[static_cast<std::size_t>(bin)] =
        std::min(over_surroundings(sums.col(0), bin), over_surroundings(sums.col(1), bin));
  }
  return prominence;
}

/// Between bins, by the parabola through the logarithms of three.
double refined(const Eigen::VectorXd& power, Eigen::Index bin) {
  const double left = std::log(power[bin - 1]), middle = std::log(power[bin]),
               right = std::log(power[bin + 1]);
  const double bend = left - 2.0 * middle + right;
  return double(bin) + (bend < 0.0 ? 0.5 * (left - right) / bend : 0.0);
}

bool is_harmonic(double of_hz, double frequency_hz) {
  const double ratio = frequency_hz / of_hz;
  return ratio > 1.5 && std::abs(ratio - std::round(ratio)) < 0.05;
}

}  // namespace

std::vector<double> oscillations_in(const RobotLog& recorded) {
  const RobotLog log = finite_samples(recorded);
  const double step_s = usual_step_s(log);
  if (!(step_s > 0.0) || log.position_m.rows() == 0) return {};
  const Eigen::Index forces = log.force.rows() > 0 ? 3 : 1;
  Eigen::MatrixXd columns(log.size(), forces + 3);
  if (forces == 3)
    columns.leftCols(3) = log.force;
  else
    columns.col(0) = log.force_along;
  columns.rightCols(3) = log.position_m;

  const auto bins = static_cast<Eigen::Index>(double(kBlock) / kSamplesPerPeriod);
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(bins, 2);
  for (const Stretch& stretch : stretches_in_time(log, kGap * step_s)) {
    for (Eigen::Index first = stretch.first; first + kBlock <= stretch.last + 1;
         first += kBlock / 2) {
      const Eigen::MatrixXd powers = powers_of(block_at(log, columns, first, step_s), bins);
      if (!powers.allFinite()) continue;
      sums.col(0) += powers.leftCols(forces).rowwise().sum();
      sums.col(1) += powers.rightCols(3).rowwise().sum();
    }
  }
  const Eigen::VectorXd together = sums.rowwise().prod();
  std::vector<double> prominence = prominence_of(sums);
  std::vector<double> found;
  const double strongest = *std::max_element(prominence.begin(), prominence.end());
  while (true) {
    const auto most = std::max_element(prominence.begin(), prominence.end());
    if (*most < std::max(kStandsOut, kRival * strongest)) return found;
    const double hz = refined(together, most - prominence.begin()) / (double(kBlock) * step_s);
    *most = 0.0;
    const bool is_known = std::any_of(found.begin(), found.end(),
                                      [&](double known) { return is_harmonic(known, hz); });
    std::erase_if(found, [&](double known) { return is_harmonic(hz, known); });
    if (!is_known) found.push_back(hz);
  }
}

}  // namespace palpation
