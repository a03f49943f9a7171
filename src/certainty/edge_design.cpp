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

/// How readings at the candidates follow the depth there, and the profile.
struct Candidates {
  std::vector<int> vertices;
  std::vector<SurfacePoint> points{};
  Eigen::VectorXd by_depth{};
  ProfileSlopes by_profile{}, by_profile_variance{};
};

/// `fit`: EdgeBelief::Fit, which is nobody else's to name; so below.
template <typename Fit>
Candidates candidates_at(const Surface& surface, const Fit& fit, const Field& depth,
                         std::vector<int> vertices) {
  Candidates made{.vertices = std::move(vertices)};
  const auto size = static_cast<Eigen::Index>(made.vertices.size());
  made.by_depth.resize(size);
  made.by_profile.resize(size, fit.edge.profile.size());
  for (Eigen::Index i = 0; i < size; ++i) {
    const int vertex = made.vertices[i];
    made.points.push_back(surface.at_vertex(vertex));
    const ReadingSlopes slopes =
        profile_slopes(fit.edge.profile, fit.part[vertex], depth[vertex] + fit.shift_m());
    made.by_depth[i] = slopes.by_depth;
    made.by_profile.row(i) = slopes.by_profile;
  }
  made.by_profile_variance = made.by_profile * fit.prior.variance.asDiagonal();
  return made;
}

/// Posterior covariances of readings at the candidates and of depths at the nodes, kept up to date
/// as candidates are picked.
class Design {
 public:
  template <typename Fit>
  Design(const Fit& fit, const BoundaryNodes& nodes, const Candidates& candidates)
      : length_m_(nodes.length_m), noise_(fit.touch_variance) {
    const Eigen::VectorXd& by_depth = candidates.by_depth;
    const ProfileSlopes& by_profile_variance = candidates.by_profile_variance;
    of_candidates_ = fit.edge.by_depth.asDiagonal() *
                     fit.correction.covariance(fit.data.places, candidates.points) *
                     by_depth.asDiagonal();
    of_candidates_ += fit.edge.by_profile * by_profile_variance.transpose();
    fit.edge.covariance.matrixL().solveInPlace(of_candidates_);
    Eigen::MatrixXd of_nodes = fit.readings_with_depths(nodes.points);
    fit.edge.covariance.matrixL().solveInPlace(of_nodes);

    const double sd = fit.correction.kernel().signal_sd, shift = fit.shift_m();
    depth_reading_ =
        fit.correction.covariance(nodes.points, candidates.points) * by_depth.asDiagonal();
    depth_reading_.rowwise() += shift * by_profile_variance.col(2).transpose();
    depth_reading_ -= of_nodes.transpose() * of_candidates_;
    depth_variance_ = (sd * sd + shift * shift * fit.prior.variance[2] -
                       of_nodes.colwise().squaredNorm().transpose().array())
                          .max(0.0);
    reading_variance_ = sd * sd * by_depth.cwiseAbs2() +
                        by_profile_variance.cwiseProduct(candidates.by_profile).rowwise().sum() -
                        of_candidates_.colwise().squaredNorm().transpose();
    reading_variance_ = reading_variance_.cwiseMax(0.0).array() + noise_;
  }

  /// How much a reading there lowers the integral of the depth's standard deviation.
  double gain(Eigen::Index candidate) const {
    double sum = 0.0;
    for (Eigen::Index node = 0; node < depth_variance_.size(); ++node) {
      const double told = depth_reading_(node, candidate) * depth_reading_(node, candidate) /
                          reading_variance_[candidate];
      sum += length_m_[node] * (std::sqrt(depth_variance_[node]) -
                                std::sqrt(std::max(depth_variance_[node] - told, 0.0)));
    }
    return sum;
  }

  /// `with_picked`: prior covariance of the candidates' readings with the picked one's.
  void pick(Eigen::Index candidate, Eigen::VectorXd with_picked) {
    with_picked -= of_candidates_.transpose() * of_candidates_.col(candidate);
    for (const Eigen::VectorXd& row : rows_) with_picked -= row * row[candidate];
    const double sd = std::sqrt(reading_variance_[candidate]);
    Eigen::VectorXd row = with_picked / sd;
    const Eigen::VectorXd told = depth_reading_.col(candidate) / sd;
    depth_reading_ -= told * row.transpose();
    depth_variance_ = (depth_variance_ - told.cwiseAbs2()).cwiseMax(0.0);
    reading_variance_ = (reading_variance_ - row.cwiseAbs2()).cwiseMax(noise_);
    rows_.push_back(std::move(row));
  }

 private:
  std::vector<double> length_m_;      // of the boundary around each node
  double noise_;                      // of a touch
  Eigen::MatrixXd of_candidates_;     // readings so far x candidates, whitened
  Eigen::MatrixXd depth_reading_;     // nodes x candidates
  Eigen::VectorXd depth_variance_;    // at the nodes
  Eigen::VectorXd reading_variance_;  // at the candidates, the touch's noise included
  std::vector<Eigen::VectorXd> rows_;
};

/// Of the candidates that gain all but the most the one where the field is least known; -1: none
/// gains anything.
int best_of(const Design& design, const std::vector<int>& vertices,
            const std::vector<bool>& allowed, const Field& field_variance) {
  std::vector<double> gains(vertices.size(), 0.0);
  for (std::size_t i = 0; i < gains.size(); ++i) {
    if (allowed[i]) gains[i] = design.gain(static_cast<Eigen::Index>(i));
  }
  const double best = *std::max_element(gains.begin(), gains.end());
  if (!(best > 0.0)) return -1;
  int picked = -1;
  for (std::size_t i = 0; i < gains.size(); ++i) {
    if (!allowed[i] || gains[i] < kAsGood * best) continue;
    if (picked < 0 || field_variance[vertices[i]] > field_variance[vertices[picked]])
      picked = static_cast<int>(i);
  }
  return picked;
}

/// Prior covariance of the candidates' readings with one of theirs.
Eigen::VectorXd covariance_with(int picked, const Surface& surface, const Prior& correction,
                                const Candidates& candidates) {
  const SurfacePoint place = surface.at_vertex(candidates.vertices[picked]);
  Eigen::VectorXd covariance =
      candidates.by_depth.cwiseProduct(
          correction.covariance(candidates.points, std::span(&place, 1)).col(0)) *
      candidates.by_depth[picked];
  covariance += candidates.by_profile_variance * candidates.by_profile.row(picked).transpose();
  return covariance;
}

}  // namespace

std::vector<int> EdgeBelief::most_telling(std::span<const int> all_candidates, int count,
                                          double least_spacing_m,
                                          const Field& field_variance) const {
  require(count >= 0, "most_telling", "count = " + std::to_string(count), "must not be negative");
  require(field_variance.size() == surface_.vertex_count(), "most_telling",
          std::to_string(field_variance.size()) + " variances", "must be one for each vertex");
  const Fit& fit = most_likely();
  const BoundaryNodes nodes = boundary_nodes(surface_, depth_);
  std::vector<int> thinned = one_per_cell(Layout(fit.correction), all_candidates);
  std::vector<int> picks;
  if (nodes.points.empty() || thinned.empty()) return picks;

  const Candidates candidates = candidates_at(surface_, fit, depth_, std::move(thinned));
  Design design(fit, nodes, candidates);
  std::vector<bool> allowed(candidates.vertices.size(), true);
  while (static_cast<int>(picks.size()) < count) {
    const int picked = best_of(design, candidates.vertices, allowed, field_variance);
    if (picked < 0) break;
    const int vertex = candidates.vertices[picked];
    picks.push_back(vertex);
    design.pick(picked, covariance_with(picked, surface_, fit.correction, candidates));
    const std::vector<int> near = vertices_near(surface_, vertex, least_spacing_m);
    for (std::size_t i = 0; i < allowed.size(); ++i) {
      if (std::binary_search(near.begin(), near.end(), candidates.vertices[i])) allowed[i] = false;
    }
    allowed[picked] = false;
  }
  return picks;
}

}  // namespace palpation
