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

double error_beside(const Eigen::VectorXd& time_s, const Eigen::VectorXd& force_left,
                    const Eigen::VectorXd& position_left, Complex ratio, double frequency_hz,
                    int periods) {
  double sum = 0.0;
  int count = 0;
  for (int m = -periods / 2; m <= periods / 2; ++m) {
    if (m == 0) continue;
    const double beside_hz = frequency_hz * (1.0 + double(m) / periods);
    Complex force = 0.0, position = 0.0;
    for (Eigen::Index i = 0; i < time_s.size(); ++i) {
      const Complex wave = std::polar(1.0, -2.0 * std::numbers::pi * beside_hz * time_s[i]);
      force += wave * force_left[i];
      position += wave * position_left[i];
    }
    sum += std::norm(2.0 / double(time_s.size()) * (force - ratio * position));
    ++count;
  }
  return sum / count;
}

}  // namespace palpation
