#include "probing/probing_axis.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "probing/robust.h"

namespace palpation {
namespace {

std::vector<Eigen::Index> rows_with_place(const RobotLog& log,
                                          const std::vector<Eigen::Index>& rows) {
  std::vector<Eigen::Index> finite;
  for (const Eigen::Index row : rows)
    if (log.position_m.row(row).allFinite()) finite.push_back(row);
  return finite;
}

/// The mean of the normals that the log names; zero where there is none.
Vec3 named_normal(const RobotLog& log, const std::vector<Eigen::Index>& rows) {
  Vec3 sum = Vec3::Zero();
  if (log.normal.rows() == 0) return sum;
  for (const Eigen::Index row : rows) {
    const Vec3 normal = log.normal.row(row);
    if (normal.allFinite() && normal.norm() > 0.0) sum += normal.normalized();
  }
  return sum.norm() > 0.0 ? Vec3(sum.normalized()) : sum;
}

/// The line along which the probe moved; zero where it did not.
Vec3 line_of_motion(const RobotLog& log, const std::vector<Eigen::Index>& rows) {
  const std::vector<Eigen::Index> finite = rows_with_place(log, rows);
  if (finite.size() < 2) return Vec3::Zero();
  Points places = log.position_m(finite, Eigen::all);
  places.rowwise() -= places.colwise().mean().eval();
  if (places.isZero(0.0)) return Vec3::Zero();
  const Eigen::Matrix3d moved = places.transpose() * places;
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moved).eigenvectors().col(2);
}

double covariance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  double mean_a = 0.0, mean_b = 0.0, sum = 0.0;
  int count = 0;
  const auto is_used = [&](Eigen::Index i) { return std::isfinite(a[i]) && std::isfinite(b[i]); };
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    if (!is_used(i)) continue;
    mean_a += a[i], mean_b += b[i], ++count;
  }
  if (count == 0) return 0.0;
  mean_a /= count, mean_b /= count;
  for (Eigen::Index i = 0; i < a.size(); ++i)
    if (is_used(i)) sum += (a[i] - mean_a) * (b[i] - mean_b);
  return sum;
}

/// How far each sample's force is from that of the shallow end, whatever its sign.
Eigen::VectorXd force_size(const RobotLog& log, const std::vector<Eigen::Index>& rows) {
  Points force(static_cast<Eigen::Index>(rows.size()), 3);
  force.setZero();
  if (log.force.rows() > 0)
    force = log.force(rows, Eigen::all);
  else
    force.col(0) = log.force_along(rows);
  std::vector<double> first[3];
  for (Eigen::Index i = 0; i < std::min<Eigen::Index>(3, force.rows()); ++i)
    for (int k = 0; k < 3; ++k) first[k].push_back(force(i, k));
  const Eigen::RowVector3d start(median_of(first[0]), median_of(first[1]), median_of(first[2]));
  return (force.rowwise() - start).rowwise().norm();
}

/// Of covariance, less than which says nothing about a sign.
constexpr double kWeak = 0.5;

/// Lines of motion point either way, and force says which; where it does not, they point as the
/// others do.
void turn_weak_ones(std::vector<AxialProbing>& probings, const std::vector<bool>& is_weak) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < probings.size(); ++i)
    if (!is_weak[i]) sum += probings[i].outward;
  for (std::size_t i = 0; i < probings.size(); ++i)
    if (is_weak[i] && sum.dot(probings[i].outward) < 0.0) probings[i].outward *= -1.0;
}

double sign_of(double value) { return value < 0.0 ? -1.0 : 1.0; }

/// Votes of all probings, each one the same.
class Vote {
 public:
  void cast(double value) { sum_ += value > 0.0 ? 1 : value < 0.0 ? -1 : 0; }
  double sign() const { return sign_of(sum_); }

 private:
  int sum_ = 0;
};

Eigen::VectorXd along(const Points& points, const std::vector<Eigen::Index>& rows,
                      const Vec3& axis) {
  return points(rows, Eigen::all) * axis;
}

}  // namespace

AxialLog along_axes(const RobotLog& log, const std::vector<std::vector<Eigen::Index>>& groups) {
  AxialLog axial;
  Vote normals_point_out;
  std::vector<bool> is_weak;
  for (const std::vector<Eigen::Index>& rows : groups) {
    AxialProbing probing{.rows = rows, .outward = named_normal(log, rows), .indentation = {}};
    const bool is_named = !probing.outward.isZero(0.0);
    if (!is_named) probing.outward = line_of_motion(log, rows);
    const Eigen::VectorXd out_m = along(log.position_m, rows, probing.outward),
                          pressed = force_size(log, rows);
    const double outwards = -covariance(out_m, pressed);
    is_weak.push_back(!is_named &&
                      !(outwards * outwards >
                        kWeak * kWeak * covariance(out_m, out_m) * covariance(pressed, pressed)));
    is_named ? normals_point_out.cast(outwards) : void(probing.outward *= sign_of(outwards));
    axial.has_axes = axial.has_axes || !probing.outward.isZero(0.0);
    axial.probings.push_back(std::move(probing));
  }
  turn_weak_ones(axial.probings, is_weak);
  Vote pressing;
  Vote deeper_grows;
  for (AxialProbing& probing : axial.probings) {
    if (!named_normal(log, probing.rows).isZero(0.0)) probing.outward *= normals_point_out.sign();
    Indentation& in = probing.indentation;
    in.depth_m = log.depth_m.size() > 0
                     ? Eigen::VectorXd(log.depth_m(probing.rows))
                     : Eigen::VectorXd(-along(log.position_m, probing.rows, probing.outward));
    in.force = log.force.rows() > 0 ? along(log.force, probing.rows, probing.outward)
                                    : Eigen::VectorXd(log.force_along(probing.rows));
    if (log.time_s.size() > 0) in.time_s = log.time_s(probing.rows);
    deeper_grows.cast(covariance(in.depth_m, force_size(log, probing.rows)));
  }
  const double down = log.depth_m.size() > 0 ? deeper_grows.sign() : 1.0;
  for (AxialProbing& probing : axial.probings) {
    probing.indentation.depth_m *= down;
    pressing.cast(covariance(probing.indentation.depth_m, probing.indentation.force));
  }
  axial.pressing_is_negative = pressing.sign() < 0.0;
  for (AxialProbing& probing : axial.probings) probing.indentation.force *= pressing.sign();
  return axial;
}

}  // namespace palpation
