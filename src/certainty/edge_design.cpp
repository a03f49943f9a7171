// Where touches would tell the most about a boundary.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "certainty/boundary_nodes.h"
#include "certainty/edge_belief_fit.h"
#include "palpation/base/error.h"
#include "palpation/geometry/distance.h"

namespace palpation {
namespace {

constexpr double kAsGood = 0.9;  // of the best
constexpr double kCell_m =
    0.0005;  // an eighth of an edge's width: of the candidates in one such cube, one is tried

std::vector<int> one_per_cell(const Layout& layout, std::span<const int> candidates) {
  std::set<std::array<long, 3>> taken;
  std::vector<int> thinned;
  for (const int vertex : candidates) {
    const Vec3 cell = (layout.at(vertex) / kCell_m).array().round();
    if (taken.insert({std::lround(cell[0]), std::lround(cell[1]), std::lround(cell[2])}).second)
      thinned.push_back(vertex);
  }
  return thinned;
}

/// Posterior covariances of readings at the candidates and of depths at the nodes, kept up to date
/// as candidates are picked.
class Design {
 public:
  Eigen::MatrixXd depth_reading;     // nodes x candidates
  Eigen::VectorXd depth_variance;    // at the nodes
  Eigen::VectorXd reading_variance;  // at the candidates, the touch's noise included

  /// How much a reading there lowers the integral of the depth's standard deviation.
  double gain(const std::vector<double>& length_m, Eigen::Index candidate) const {
    double sum = 0.0;
    for (Eigen::Index node = 0; node < depth_variance.size(); ++node) {
      const double told = depth_reading(node, candidate) * depth_reading(node, candidate) /
                          reading_variance[candidate];
      sum += length_m[node] * (std::sqrt(depth_variance[node]) -
                               std::sqrt(std::max(depth_variance[node] - told, 0.0)));
    }
    return sum;
  }

  /// `with_picked`: posterior covariance of the candidates' readings with the picked one's, before
  /// any pick.
  void pick(Eigen::Index candidate, Eigen::VectorXd with_picked) {
    for (const Eigen::VectorXd& row : rows_) with_picked -= row * row[candidate];
    const double sd = std::sqrt(reading_variance[candidate]);
    Eigen::VectorXd row = with_picked / sd;
    const Eigen::VectorXd told = depth_reading.col(candidate) / sd;
    depth_reading -= told * row.transpose();
    depth_variance = (depth_variance - told.cwiseAbs2()).cwiseMax(0.0);
    reading_variance = (reading_variance - row.cwiseAbs2()).cwiseMax(noise);
    rows_.push_back(std::move(row));
  }

  double noise = 0.0;

 private:
  std::vector<Eigen::VectorXd> rows_;
};

}  // namespace

std::vector<int> EdgeBelief::most_telling(std::span<const int> all_candidates, int count,
                                          double least_spacing_m,
                                          const Field& field_variance) const {
  require(count >= 0, "most_telling", "count = " + std::to_string(count), "must not be negative");
  require(field_variance.size() == surface_.vertex_count(), "most_telling",
          std::to_string(field_variance.size()) + " variances", "must be one for each vertex");
  const Fit& fit = most_likely();
  const BoundaryNodes nodes = boundary_nodes(surface_, depth_);
  const std::vector<int> candidates = one_per_cell(Layout(fit.correction), all_candidates);
  std::vector<int> picks;
  if (nodes.points.empty() || candidates.empty()) return picks;

  std::vector<SurfacePoint> points;
  const auto size = static_cast<Eigen::Index>(candidates.size());
  Eigen::VectorXd by_depth(size);
  ProfileSlopes by_profile(size, fit.edge.profile.size());
  for (Eigen::Index i = 0; i < size; ++i) {
    const int vertex = candidates[i];
    points.push_back(surface_.at_vertex(vertex));
    const ReadingSlopes slopes =
        profile_slopes(fit.edge.profile, fit.part[vertex], depth_[vertex] + fit.shift_m());
    by_depth[i] = slopes.by_depth;
    by_profile.row(i) = slopes.by_profile;
  }
  const ProfileSlopes by_profile_variance = by_profile * fit.prior.variance.asDiagonal();

  // Whitened covariances with the readings so far.
  Eigen::MatrixXd of_candidates = fit.edge.by_depth.asDiagonal() *
                                  fit.correction.covariance(fit.data.places, points) *
                                  by_depth.asDiagonal();
  of_candidates += fit.edge.by_profile * by_profile_variance.transpose();
  fit.edge.covariance.matrixL().solveInPlace(of_candidates);
  Eigen::MatrixXd of_nodes = fit.readings_with_depths(nodes.points);
  fit.edge.covariance.matrixL().solveInPlace(of_nodes);

  const double sd = fit.correction.kernel().signal_sd, shift = fit.shift_m();
  Design design;
  design.noise = fit.touch_variance;
  design.depth_reading = fit.correction.covariance(nodes.points, points) * by_depth.asDiagonal();
  design.depth_reading.rowwise() += shift * by_profile_variance.col(2).transpose();
  design.depth_reading -= of_nodes.transpose() * of_candidates;
  design.depth_variance = (sd * sd + shift * shift * fit.prior.variance[2] -
                           of_nodes.colwise().squaredNorm().transpose().array())
                              .max(0.0);
  design.reading_variance = sd * sd * by_depth.cwiseAbs2() +
                            by_profile_variance.cwiseProduct(by_profile).rowwise().sum() -
                            of_candidates.colwise().squaredNorm().transpose();
  design.reading_variance = design.reading_variance.cwiseMax(0.0).array() + design.noise;

  std::vector<bool> allowed(candidates.size(), true);
  while (static_cast<int>(picks.size()) < count) {
    std::vector<double> gains(candidates.size(), 0.0);
    for (std::size_t i = 0; i < gains.size(); ++i) {
      if (allowed[i]) gains[i] = design.gain(nodes.length_m, static_cast<Eigen::Index>(i));
    }
    const double best = *std::max_element(gains.begin(), gains.end());
    if (!(best > 0.0)) break;
    int picked = -1;
    for (std::size_t i = 0; i < gains.size(); ++i) {
      if (!allowed[i] || gains[i] < kAsGood * best) continue;
      if (picked < 0 || field_variance[candidates[i]] > field_variance[candidates[picked]])
        picked = static_cast<int>(i);
    }
    const int vertex = candidates[picked];
    picks.push_back(vertex);
    const SurfacePoint place = surface_.at_vertex(vertex);
    Eigen::VectorXd with_picked =
        by_depth.cwiseProduct(fit.correction.covariance(points, std::span(&place, 1)).col(0)) *
        by_depth[picked];
    with_picked += by_profile_variance * by_profile.row(picked).transpose();
    with_picked -= of_candidates.transpose() * of_candidates.col(picked);
    design.pick(picked, std::move(with_picked));
    const std::vector<int> near = vertices_near(surface_, vertex, least_spacing_m);
    for (std::size_t i = 0; i < allowed.size(); ++i) {
      if (std::binary_search(near.begin(), near.end(), candidates[i])) allowed[i] = false;
    }
    allowed[picked] = false;
  }
  return picks;
}

}  // namespace palpation
