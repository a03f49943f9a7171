#include "certainty/outline_disagreement.h"

#include <cmath>

#include "certainty/outline_pieces.h"

namespace palpation {

double disagreement_of(std::span<const OutlineDraw> draws, std::span<const Vec2> places) {
  Eigen::MatrixXd depths(std::ssize(places), std::ssize(draws));
  for (Eigen::Index i = 0; i < depths.cols(); ++i) {
    const OutlinePieces pieces(draws[static_cast<std::size_t>(i)].outline);
    for (Eigen::Index j = 0; j < depths.rows(); ++j)
      depths(j, i) = pieces.depth_at(places[static_cast<std::size_t>(j)]);
  }
  const Eigen::Index half = depths.cols() / 2;
  const Eigen::VectorXd one = depths.leftCols(half).rowwise().mean(),
                        other = depths.rightCols(half).rowwise().mean();
  depths.leftCols(half).colwise() -= one;
  depths.rightCols(half).colwise() -= other;
  const double variance = depths.squaredNorm() / static_cast<double>(depths.cols());
  return variance > 0.0 ? std::sqrt((one - other).squaredNorm() / variance) : 0.0;
}

}  // namespace palpation
