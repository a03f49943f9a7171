#include "palpation/robot/registration.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <string>

#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kLeastSpread_m = 0.001;  // beside a line
constexpr double kSameSize = 0.2;         // of spreads, relative
constexpr double kFarthest_m = 0.010;     // of a touched place from the surface
constexpr double kLoosest = 30.0;         // of a move that touches hardly tell: times their own sd
constexpr double kRest_m = 1e-9;
constexpr int kMostSteps = 100;
constexpr double kTwoSided95 = 1.959963984540054;

using Rows6 = Eigen::Matrix<double, Eigen::Dynamic, 6>;

Vec3 mean_of(std::span<const TouchedPair> pairs, Vec3 TouchedPair::*side) {
  Vec3 sum = Vec3::Zero();
  for (const TouchedPair& pair : pairs) sum += pair.*side;
  return sum / static_cast<double>(pairs.size());
}

Points centred(std::span<const TouchedPair> pairs, Vec3 TouchedPair::*side, const Vec3& centre) {
  Points points(static_cast<Eigen::Index>(pairs.size()), 3);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    points.row(static_cast<Eigen::Index>(i)) = (pairs[i].*side - centre).transpose();
  return points;
}

/// Root mean squares along the principal axes, falling.
Vec3 spreads(const Points& points) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd{Eigen::MatrixXd(points)};
  Vec3 spread = Vec3::Zero();
  spread.head(svd.singularValues().size()) =
      svd.singularValues() / std::sqrt(static_cast<double>(points.rows()));
  return spread;
}

void check_pairs(std::span<const TouchedPair> pairs) {
  require(pairs.size() >= 3, "register_pairs", std::to_string(pairs.size()) + " pairs",
          "must be three at least");
  for (std::size_t i = 0; i < pairs.size(); ++i)
    require(pairs[i].tissue.allFinite() && pairs[i].robot.allFinite() &&
                pairs[i].tissue.norm() < 1e6 && pairs[i].robot.norm() < 1e6,
            "register_pairs", "pair " + std::to_string(i), "must be finite, in metres");
}

void check_spreads(const Vec3& tissue, const Vec3& robot) {
  const double ratio = robot.norm() / std::max(tissue.norm(), 1e-300);
  require(std::abs(ratio - 1.0) <= kSameSize, "register_pairs",
          "places that spread over " + text_of(robot.norm()) + " m in the robot's frame and " +
              text_of(tissue.norm()) + " m on the tissue",
          ratio > 100.0 || ratio < 0.01 ? "must be in one unit: is one of them in millimetres?"
                                        : "must be of one size: are they paired right?");
  require(std::min(tissue.y(), robot.y()) >= kLeastSpread_m, "register_pairs",
          "places that spread " + text_of(std::min(tissue.y(), robot.y())) + " m beside one line",
          "must spread a millimetre at least: touch somewhere beside it");
}

Eigen::Matrix3d cross_matrix(const Vec3& v) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return matrix;
}

/// What a small turn about the centre and a shift do to a place.
Eigen::Matrix<double, 3, 6> moves_of(const Vec3& from_centre) {
  Eigen::Matrix<double, 3, 6> moves;
  moves << -cross_matrix(from_centre), Eigen::Matrix3d::Identity();
  return moves;
}

double variance_of(double squares, Eigen::Index equations, double touch_sd_m) {
  const double freedom = static_cast<double>(equations - 6);
  const double seen = freedom > 0.0 ? squares / freedom : 0.0;
  return std::max(seen, touch_sd_m * touch_sd_m);
}

void note_residuals(Registration& registration) {
  double squares = 0.0;
  for (const double one : registration.residuals_m) squares += one * one;
  registration.rms_m = std::sqrt(squares / static_cast<double>(registration.residuals_m.size()));
}

/// A set of touched places against the surface where the tissue is taken to be.
struct Misfit {
  Rows6 rows;
  Eigen::VectorXd off_m;
};

Misfit misfit(const Surface& surface, std::span<const Vec3> touched,
              const Eigen::Isometry3d& from_tissue, const Vec3& centre) {
  const auto count = static_cast<Eigen::Index>(touched.size());
  Misfit result{Rows6(count, 6), Eigen::VectorXd(count)};
  const Eigen::Isometry3d to_tissue = from_tissue.inverse();
  for (Eigen::Index i = 0; i < count; ++i) {
    const Vec3& place = touched[static_cast<std::size_t>(i)];
    const SurfacePoint closest = surface.project(to_tissue * place);
    const Vec3 on_tissue = from_tissue * surface.position(closest);
    const Vec3 normal = from_tissue.linear() * surface.normal(closest);
    require((place - on_tissue).norm() <= kFarthest_m, "refine_on_surface",
            "place " + std::to_string(i) + ", " + text_of((place - on_tissue).norm()) +
                " m from the tissue",
            "must be within 10 mm of it: is the first guess right?");
    result.off_m[i] = normal.dot(place - on_tissue);
    result.rows.row(i) = normal.transpose() * moves_of(on_tissue - centre);
  }
  return result;
}

/// The turns are weighed by how far the places lie from their centre, so that all are lengths.
void check_hold(const Rows6& rows, double reach_m) {
  Rows6 scaled = rows;
  scaled.leftCols<3>() /= reach_m;
  const Covariance6 normal = scaled.transpose() * scaled;
  const Eigen::SelfAdjointEigenSolver<Covariance6> solver(normal);
  const double loose = 1.0 / std::sqrt(std::max(solver.eigenvalues()[0], 1e-300));
  require(loose <= kLoosest, "refine_on_surface", "places on tissue of this shape",
          "must hold it in place: it can slide or turn along itself, as a plane, a sphere or a "
          "cylinder can. Touch where it curves otherwise, or register by pairs alone");
}

/// The greatest over the vertices of what a place's covariance and the normal there give, as the
/// distance that 95 % stay within.
template <typename Variance>
double greatest_m(const Surface& surface, const Registration& registration,
                  const Variance& variance) {
  const Eigen::Isometry3d from_tissue(registration.from_tissue);
  double most = 0.0;
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    const Vec3 normal = from_tissue.linear() * surface.vertex_normals().row(vertex).transpose();
    const Eigen::Matrix<double, 3, 6> moves =
        moves_of(from_tissue * surface.vertex(vertex) - registration.centre);
    const Eigen::Matrix3d covariance = moves * registration.covariance * moves.transpose();
    most = std::max(most, variance(covariance, normal));
  }
  return kTwoSided95 * std::sqrt(most);
}

}  // namespace

Registration register_pairs(std::span<const TouchedPair> pairs, double touch_sd_m) {
  require(std::isfinite(touch_sd_m) && touch_sd_m > 0.0, "register_pairs", "touch_sd_m",
          "must be finite and positive");
  check_pairs(pairs);
  const Vec3 tissue_centre = mean_of(pairs, &TouchedPair::tissue),
             robot_centre = mean_of(pairs, &TouchedPair::robot);
  const Points tissue = centred(pairs, &TouchedPair::tissue, tissue_centre),
               robot = centred(pairs, &TouchedPair::robot, robot_centre);
  const Vec3 tissue_spread = spreads(tissue), robot_spread = spreads(robot);
  check_spreads(tissue_spread, robot_spread);
  // Umeyama 1991, equations 40 to 42, c = 1.
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(Eigen::Matrix3d(robot.transpose() * tissue),
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d sign = Eigen::Matrix3d::Identity();
  const double handed = svd.matrixU().determinant() * svd.matrixV().determinant();
  if (handed < 0.0) sign(2, 2) = -1.0;
  require(handed > 0.0 || tissue_spread.z() < kLeastSpread_m || robot_spread.z() < kLeastSpread_m,
          "register_pairs", "places that fit only as in a mirror",
          "must be of one hand: is an axis turned round, or are two pairs exchanged?");
  const Eigen::Matrix3d turn = svd.matrixU() * sign * svd.matrixV().transpose();

  Registration registration;
  registration.from_tissue.topLeftCorner<3, 3>() = turn;
  registration.from_tissue.topRightCorner<3, 1>() = robot_centre - turn * tissue_centre;
  registration.centre = robot_centre;
  Covariance6 normal = Covariance6::Zero();
  double squares = 0.0;
  for (Eigen::Index i = 0; i < tissue.rows(); ++i) {
    const Vec3 moved = turn * tissue.row(i).transpose();
    const double off_m = (Vec3(robot.row(i)) - moved).norm();
    registration.residuals_m.push_back(off_m);
    squares += off_m * off_m;
    const Eigen::Matrix<double, 3, 6> moves = moves_of(moved);
    normal += moves.transpose() * moves;
  }
  note_residuals(registration);
  registration.covariance = variance_of(squares, 3 * tissue.rows(), touch_sd_m) * normal.inverse();
  return registration;
}

Registration refine_on_surface(const Surface& surface, std::span<const Vec3> touched,
                               const Registration& guess, double touch_sd_m) {
  require(touched.size() >= 6, "refine_on_surface", std::to_string(touched.size()) + " places",
          "must be six at least");
  Vec3 centre = Vec3::Zero();
  for (const Vec3& place : touched) {
    require(place.allFinite(), "refine_on_surface", "a place", "must be finite, in metres");
    centre += place / static_cast<double>(touched.size());
  }
  double reach_m = 0.0;
  for (const Vec3& place : touched) reach_m = std::max(reach_m, (place - centre).norm());
  Eigen::Isometry3d from_tissue(guess.from_tissue);
  for (int step = 0; step < kMostSteps; ++step) {
    const Misfit now = misfit(surface, touched, from_tissue, centre);
    check_hold(now.rows, reach_m);
    const Covariance6 normal = now.rows.transpose() * now.rows;
    const Eigen::Matrix<double, 6, 1> move = normal.ldlt().solve(now.rows.transpose() * now.off_m);
    const Vec3 turn = move.head<3>();
    Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
    moved.translate(centre + Vec3(move.tail<3>()));
    if (turn.norm() > 0.0) moved.rotate(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
    moved.translate(-centre);
    from_tissue = moved * from_tissue;
    if (move.tail<3>().norm() + turn.norm() * reach_m > kRest_m) continue;
    Registration registration;
    registration.from_tissue = from_tissue.matrix();
    registration.centre = centre;
    const Misfit last = misfit(surface, touched, from_tissue, centre);
    registration.residuals_m.assign(last.off_m.begin(), last.off_m.end());
    for (double& one : registration.residuals_m) one = std::abs(one);
    note_residuals(registration);
    registration.covariance = variance_of(last.off_m.squaredNorm(), last.off_m.size(), touch_sd_m) *
                              Covariance6(last.rows.transpose() * last.rows).inverse();
    return registration;
  }
  throw NumericalError("refine_on_surface: did not come to rest in " + std::to_string(kMostSteps) +
                       " steps: start nearer, or touch elsewhere");
}

double uncertainty_along_normal_m(const Surface& surface, const Registration& registration) {
  return greatest_m(surface, registration,
                    [](const Eigen::Matrix3d& covariance, const Vec3& normal) {
                      return normal.dot(covariance * normal);
                    });
}

double uncertainty_along_surface_m(const Surface& surface, const Registration& registration) {
  return greatest_m(
      surface, registration, [](const Eigen::Matrix3d& covariance, const Vec3& normal) {
        const Eigen::Matrix3d along = Eigen::Matrix3d::Identity() - normal * normal.transpose();
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
            Eigen::Matrix3d(along * covariance * along), Eigen::EigenvaluesOnly);
        return solver.eigenvalues()[2];
      });
}

}  // namespace palpation
