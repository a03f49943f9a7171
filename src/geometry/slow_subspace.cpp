#include "geometry/slow_subspace.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <utility>

#include "palpation/base/parallel.h"

namespace palpation {
namespace {

constexpr int kSolves = 8;
constexpr double kDependent = 1e-13;  // of a unit diagonal: directions that rounding made

}  // namespace

void filter(std::vector<Strip>& block, const ShiftedLaplacian& laplacian, double end) {
  const double shift = laplacian.shift;
  const double s = 1.0 / (1.0 + end / shift);
  for_ranges(static_cast<int>(block.size()), 1, [&](int first, int last) {
    Strip product;
    const auto apply = [&](const Strip& in) {
      multiply(laplacian.mass, in, product);
      laplacian.factor.solve(product);
    };
    for (int i = first; i < last; ++i) {
      apply(block[i]);
      Strip before = product;
      combine(shift, before, 0.0, before, 0.0, before);  // T_0
      apply(before);
      Strip here = product;
      combine(2.0 * shift / s, here, -1.0, before, 0.0, before);  // T_1
      for (int q = 2; q < kSolves; ++q) {
        apply(here);
        combine(-1.0, before, 4.0 * shift / s, product, -2.0, here);
        std::swap(before, here);
      }
      block[i] = std::move(here);
    }
  });
}

Eigen::MatrixXd gram(const std::vector<Strip>& block, const Eigen::SparseMatrix<double>& a) {
  constexpr int kGroup = 4;
  constexpr long kRowsAtOnce = 128;
  using Square = Eigen::Matrix<double, kStrip, kStrip, Eigen::RowMajor>;
  const int strips = static_cast<int>(block.size());
  Eigen::MatrixXd result(strips * kStrip, strips * kStrip);
  for_ranges((strips + kGroup - 1) / kGroup, 1, [&](int first_group, int last_group) {
    for (int start = first_group * kGroup; start < std::min(last_group * kGroup, strips);
         start += kGroup) {
      const int end = std::min(start + kGroup, strips);
      std::vector<Strip> products(static_cast<std::size_t>(end - start));
      for (int j = start; j < end; ++j) multiply(a, block[j], products[j - start]);
      std::vector<Square> sums(static_cast<std::size_t>((end - start) * strips), Square::Zero());
      for (long row = 0; row < a.cols(); row += kRowsAtOnce) {
        const long count = std::min<long>(kRowsAtOnce, a.cols() - row);
        for (int i = start; i < strips; ++i) {
          for (int j = start; j < end; ++j) {
            add_gram(block[i].data() + row * kStrip, products[j - start].data() + row * kStrip,
                     count, sums[(j - start) * strips + i].data());
          }
        }
      }
      for (int j = start; j < end; ++j) {
        for (int i = j; i < strips; ++i) {
          const Square& sum = sums[(j - start) * strips + i];
          result.block<kStrip, kStrip>(j * kStrip, i * kStrip) = sum.transpose();
          result.block<kStrip, kStrip>(i * kStrip, j * kStrip) = sum;
        }
      }
    }
  });
  return 0.5 * (result + result.transpose());
}

Ritz ritz(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass) {
  const Eigen::VectorXd scale = mass.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> whole(scale.asDiagonal() * mass *
                                                             scale.asDiagonal());
  Eigen::Index dependent = 0;
  while (dependent < scale.size() && !(whole.eigenvalues()[dependent] > kDependent)) ++dependent;
  const Eigen::Index kept = scale.size() - dependent;
  const Eigen::MatrixXd basis =
      scale.asDiagonal() * whole.eigenvectors().rightCols(kept) *
      whole.eigenvalues().tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  const Eigen::MatrixXd reduced = basis.transpose() * stiffness * basis;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(0.5 * (reduced + reduced.transpose()));
  return {modes.eigenvalues(), basis * modes.eigenvectors()};
}

}  // namespace palpation
