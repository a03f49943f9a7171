#include "readings/contact.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "readings/readings.h"
#include "readings/robust.h"

namespace palpation {
namespace {

constexpr double kHealthyShare = 0.3;  // of the tissue reads less than what is taken for healthy
constexpr double kLeastFall = 0.15;    // of the contrast: what moves a boundary at half of it by a
                                       // fifth of a millimetre, and more
constexpr double kSure = 4.0;          // standard errors
constexpr double kSmoothing = 1e-3;  // of the range: deviations that are less count as squares, and
constexpr double kTold = 1e-2;       // a fall of the plane is told from what that leaves
constexpr Eigen::Index kLeastReadings = 20;
constexpr int kRounds = 60;

/// The places in the plane that fits them best, centred.
Eigen::MatrixX2d in_plane(const Eigen::MatrixX3d& places, Eigen::Matrix<double, 3, 2>& axes) {
  const Eigen::RowVector3d middle = places.colwise().mean();
  const Eigen::MatrixX3d centred = places.rowwise() - middle;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> directions(centred.transpose() * centred);
  axes = directions.eigenvectors().rightCols<2>();
  return centred * axes;
}

/// The part of the tissue that each reading stands for: one over the readings as near to it as
/// readings are on average. Chosen touches crowd at a tumour's edge, and would else outvote healthy
/// tissue.
Eigen::VectorXd shares_of_tissue(const Eigen::MatrixX2d& places, const Eigen::Vector2d& spread) {
  const Eigen::Index count = places.rows();
  const double radius =
      std::sqrt(12.0 * spread.prod() /
                static_cast<double>(count));  // of readings spread evenly over a rectangle
  Eigen::VectorXd shares(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto squares = (places.rowwise() - places.row(i)).rowwise().squaredNorm();
    shares[i] = 1.0 / static_cast<double>((squares.array() <= radius * radius).count());
  }
  return shares;
}

/// Constant and slopes of the plane that a share of the tissue reads less than: least weighted
/// squares until the absolute deviations are least.
Eigen::Vector3d quantile_plane(const Eigen::MatrixX3d& design, const Eigen::VectorXd& readings,
                               const Eigen::VectorXd& tissue, double share, double scale) {
  Eigen::VectorXd weights = tissue;
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::MatrixX3d weighted = weights.asDiagonal() * design;
    plane = (design.transpose() * weighted).ldlt().solve(weighted.transpose() * readings);
    const Eigen::VectorXd residuals = readings - design * plane;
    for (Eigen::Index i = 0; i < residuals.size(); ++i) {
      weights[i] = tissue[i] * (residuals[i] > 0.0 ? share : 1.0 - share) /
                   std::max(std::abs(residuals[i]), kSmoothing * scale);
    }
  }
  return plane;
}

}  // namespace

std::optional<FadingContact> fading_contact(const Surface& surface,
                                            std::span<const Palpation> palpations) {
  const auto [places, readings] = placed_readings(surface, palpations);
  const Eigen::Index count = readings.size();
  if (count < kLeastReadings) return std::nullopt;
  const double range = readings.maxCoeff() - readings.minCoeff();
  if (range == 0.0) return std::nullopt;
  Eigen::Matrix<double, 3, 2> axes;
  const Eigen::MatrixX2d plane_places = in_plane(places, axes);
  const Eigen::Vector2d spread = plane_places.array().square().colwise().mean().sqrt();
  if (spread.minCoeff() < 1e-3 * spread.maxCoeff()) return std::nullopt;
  Eigen::MatrixX3d design(count, 3);
  design << Eigen::VectorXd::Ones(count), plane_places.col(0) / spread[0],
      plane_places.col(1) / spread[1];
  const Eigen::VectorXd tissue = shares_of_tissue(plane_places, spread);
  const Eigen::Vector3d plane = quantile_plane(design, readings, tissue, kHealthyShare, range);

  const Eigen::Vector2d slope = plane.tail<2>().cwiseQuotient(spread);
  if (slope.isZero(0.0)) return std::nullopt;
  const Eigen::Vector2d downhill = -slope.normalized();
  const Eigen::VectorXd along = plane_places * downhill;
  const Eigen::VectorXd above = readings - design * plane;
  const std::vector<double> heights(above.begin(), above.end());
  const double contrast = quantile(heights, 0.98) - quantile(heights, 0.02);
  const double length = along.maxCoeff() - along.minCoeff();
  const double fall = slope.norm() * length;
  const double along_sd = std::sqrt(along.array().square().mean());
  const double like_so_many = tissue.sum() * tissue.sum() / tissue.squaredNorm();
  const double chance = robust_sd(heights) * length / (along_sd * std::sqrt(like_so_many));
  if (!(fall > std::max({kLeastFall * contrast, kSure * chance, kTold * range})))
    return std::nullopt;

  double best = 0.0, last = 0.0;
  for (int third = 0; third < 3; ++third) {
    std::vector<double> there;
    for (Eigen::Index i = 0; i < count; ++i) {
      const double share = (along[i] - along.minCoeff()) / length;
      if (share >= third / 3.0 && share <= (third + 1) / 3.0) there.push_back(above[i]);
    }
    last = there.empty() ? 0.0 : std::max(0.0, quantile(there, 0.98));
    best = std::max(best, last);
  }
  return FadingContact{axes * downhill, fall / contrast, best > 0.0 ? last / best : 1.0};
}

}  // namespace palpation
