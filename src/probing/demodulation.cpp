#include "probing/demodulation.h"

#include <cmath>
#include <numbers>

namespace palpation {

Eigen::MatrixXd basis_of(const Eigen::VectorXd& time_s, double frequency_hz, double half_s) {
  Eigen::MatrixXd basis(time_s.size(), kDrift + 2 * kHarmonics);
  basis.col(0).setOnes();
  for (Eigen::Index i = 1; i < kDrift; ++i)
    basis.col(i) = basis.col(i - 1).cwiseProduct(time_s) / half_s;
  for (Eigen::Index h = 0; h < kHarmonics; ++h) {
    const Eigen::ArrayXd angle =
        2.0 * std::numbers::pi * frequency_hz * double(h + 1) * time_s.array();
    basis.col(kDrift + 2 * h) = angle.cos();
    basis.col(kDrift + 2 * h + 1) = angle.sin();
  }
  return basis;
}

Demodulated demodulate(const Eigen::HouseholderQR<Eigen::MatrixXd>& solver,
                       const Eigen::MatrixXd& basis, const Eigen::MatrixXd& columns) {
  const Eigen::MatrixXd coefficients = solver.solve(columns);
  Demodulated parts{Eigen::MatrixXcd(kHarmonics, columns.cols()), columns - basis * coefficients};
  for (Eigen::Index h = 0; h < kHarmonics; ++h)
    parts.amplitudes.row(h) = coefficients.row(kDrift + 2 * h).cast<Complex>() -
                              Complex(0, 1) * coefficients.row(kDrift + 2 * h + 1).cast<Complex>();
  return parts;
}

Beside::Beside(const Eigen::VectorXd& time_s, const Eigen::HouseholderQR<Eigen::MatrixXd>& solver,
               const Eigen::MatrixXd& basis, double frequency_hz, int periods)
    : waves_(time_s.size(), 2 * (periods / 2)), left_(waves_.cols()) {
  const auto n = static_cast<double>(time_s.size());
  Eigen::Index column = 0;
  for (int m = -(periods / 2); m <= periods / 2; ++m) {
    if (m == 0) continue;
    const double beside = -2.0 * std::numbers::pi * frequency_hz * (1.0 + double(m) / periods);
    for (Eigen::Index i = 0; i < time_s.size(); ++i)
      waves_(i, column) = std::polar(1.0, beside * time_s[i]);
    Eigen::MatrixXd parts(time_s.size(), 2);
    parts << waves_.col(column).real(), waves_.col(column).imag();
    left_[column++] = (parts - basis * solver.solve(parts)).squaredNorm() / n;
  }
  const Eigen::Index count = basis.cols();
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(count, count).middleCols(kDrift, 2);
  const auto triangle = solver.matrixQR().topRows(count).template triangularView<Eigen::Upper>();
  own_ = triangle.transpose().solve(unit).squaredNorm() * n / 4.0;
}

double Beside::error(const Eigen::VectorXd& force_left, const Eigen::VectorXd& position_left,
                     Complex ratio) const {
  const Eigen::VectorXcd left = force_left.cast<Complex>() - ratio * position_left.cast<Complex>();
  const Eigen::VectorXcd amplitudes = 2.0 / double(left.size()) * (waves_.transpose() * left);
  return own_ * amplitudes.cwiseAbs2().cwiseQuotient(left_).mean();
}

}  // namespace palpation
