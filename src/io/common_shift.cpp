#include "io/common_shift.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "io/number_text.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr Eigen::Index kEnough = 12;  // positions, for four numbers
constexpr double kLeast_m = 0.0015;   // a probe that goes in by half a millimetre feigns less
constexpr double kSurely = 4.0;       // standard deviations
constexpr double kExplained = 0.5;    // of the heights' variance
constexpr double kMost_m = 0.005;     // farther off no position is taken
constexpr double kWorstSd_m = 0.0005;
constexpr double kCurved = 0.15;  // radians that normals vary by, root mean square
constexpr double kUneven_m = 0.0003;

/// To a tenth of a millimetre.
std::string metres(double length_m) { return text_of(std::round(1e4 * length_m) / 1e4 + 0.0); }

}  // namespace

std::optional<CommonShift> common_shift(const Surface& surface, std::span<const Vec3> positions,
                                        std::span<const SurfacePoint> places) {
  const auto count = std::ssize(positions);
  if (count < kEnough) return std::nullopt;
  Eigen::MatrixX3d normals(count, 3);
  Eigen::VectorXd heights(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const SurfacePoint& place = places[static_cast<std::size_t>(i)];
    normals.row(i) = surface.normal(place);
    heights[i] =
        normals.row(i).dot(positions[static_cast<std::size_t>(i)] - surface.position(place));
  }
  normals.rowwise() -= normals.colwise().mean().eval();
  heights.array() -= heights.mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> information(normals.transpose() * normals);
  const Eigen::Matrix3d& ways = information.eigenvectors();
  const Vec3 pull = ways.transpose() * normals.transpose() * heights;
  const double scatter_m = std::sqrt(heights.squaredNorm() / static_cast<double>(count));
  CommonShift found;
  Vec3 variance = Vec3::Zero();
  for (int way = 0; way < 3; ++way) {
    const double told = information.eigenvalues()[way];
    if (told < kCurved * kCurved * static_cast<double>(count) ||
        scatter_m > kWorstSd_m * std::sqrt(told))
      continue;
    found.shift_m += pull[way] / told * ways.col(way);
    variance[way] = 1.0 / told;
  }
  const double left = (heights - normals * found.shift_m).squaredNorm();
  const double noise = std::sqrt(left / static_cast<double>(count - 4));
  found.sd_m = noise * std::sqrt(variance.sum());
  const double length_m = found.shift_m.norm();
  if (scatter_m < kUneven_m || length_m < kLeast_m || length_m > kMost_m ||
      length_m < kSurely * found.sd_m || left > (1.0 - kExplained) * heights.squaredNorm())
    return std::nullopt;
  return found;
}

std::string shift_words(const std::string& name, const CommonShift& shift) {
  const Vec3& by = shift.shift_m;
  return name + ": positions lie above the surface on one side and below it on the other, as if " +
         "all were (" + metres(by.x()) + ", " + metres(by.y()) + ", " + metres(by.z()) +
         ") m from where they were made (sd " + length_text(shift.sd_m) +
         " m): or turned by as much: the outline lies off, which its band does not know. Register "
         "the "
         "tissue anew: palpate register.";
}

}  // namespace palpation
