#include "belief/features.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ranges>
#include <utility>

#include "palpation/base/parallel.h"

namespace palpation {
namespace {

constexpr int kTilesAtOnce = 16;
constexpr std::size_t kCandidates = 1536;     // vertices that pivots are chosen from
constexpr std::size_t kMoreCandidates = 512;  // and places that they then turn out to miss
constexpr int kMostRounds = 6;
constexpr int kLookAhead = 7;  // tiles: the first round looks at one of them
/// Candidates are brought this far below the tolerance, since there is something between them.
constexpr double kMargin = 0.1;

Site site_at(const Prior& prior, const SurfacePoint& where) {
  return {where, prior.place(where), {}, {}, {}};
}

/// Evenly among the vertices, and as many along the borders, where the field is known from one side
/// alone.
std::vector<Site> first_candidates(const Prior& prior) {
  const Surface& surface = prior.surface();
  std::vector<Site> candidates;
  const auto take_evenly = [&](const auto& vertices) {
    const std::size_t size = std::size(vertices), count = std::min(kCandidates, size);
    for (std::size_t i = 0; i < count; ++i)
      candidates.push_back(site_at(prior, surface.at_vertex(vertices[i * size / count])));
  };
  take_evenly(std::views::iota(0, surface.vertex_count()));
  for (const std::vector<int>& loop : surface.border_loops()) take_evenly(loop);
  return candidates;
}

/// The places of greatest residual above the tolerance, the worst first.
std::vector<int> worst(const Eigen::VectorXd& residuals, double tolerance) {
  std::vector<int> order;
  for (int i = 0; i < residuals.size(); ++i) {
    if (residuals[i] > tolerance) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return residuals[a] > residuals[b]; });
  order.resize(std::min(order.size(), kMoreCandidates));
  return order;
}

Eigen::VectorXd residuals_of(const Eigen::MatrixXd& features) {
  return 1.0 - features.colwise().squaredNorm().transpose().array();
}

}  // namespace

/// Greedily, until no candidate's residual is above the margin. False if that would take more than
/// `most` pivots.
bool Features::choose_pivots(const Prior& prior, std::span<const Site> candidates, double tolerance,
                             int most) {
  const auto count = static_cast<Eigen::Index>(candidates.size());
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Rows features(std::min<Eigen::Index>(most, count),
                count);  // every row one feature at all candidates
  Eigen::VectorXd residuals = Eigen::VectorXd::Ones(count);
  std::vector<Eigen::Index> chosen;
  while (true) {
    Eigen::Index pivot = 0;
    const double greatest = residuals.maxCoeff(&pivot);
    if (greatest <= kMargin * tolerance) break;
    const auto row = static_cast<Eigen::Index>(chosen.size());
    if (row == features.rows()) return false;
    auto feature = features.row(row);
    feature = correlations_with(prior, candidates[pivot].place, candidates).transpose();
    feature.noalias() -= features.col(pivot).head(row).transpose() * features.topRows(row);
    const double root = std::sqrt(greatest);
    feature /= root;
    feature[pivot] = root;
    residuals.array() -= feature.transpose().array().square();
    residuals[pivot] = 0.0;
    chosen.push_back(pivot);
    pivots_.push_back(candidates[pivot]);
  }
  Rows factor = Rows::Zero(rank(), rank());
  for (int row = 0; row < rank(); ++row)
    factor.row(row).head(row + 1) = features.col(chosen[row]).head(row + 1).transpose();
  factor_.emplace(factor.data(), rank(), rank(), rank());
  return true;
}

/// Features and residuals at every vertex, or the residuals alone in one tile of `step`.
void Features::visit_vertices(const Prior& prior, int step) {
  tiles_ = &prior.tiles();
  const int vertices = tiles_->vertex_count(), tiles = tiles_->count();
  const bool keeps = step == 1;
  if (keeps) rows_ = aligned_doubles(static_cast<std::size_t>(tiles) * rank() * kLanes);
  const TileCorrelations correlations(prior, pivots_);
  const long per_tile = static_cast<long>(rank()) * kLanes;
  residuals_ = Field::Zero(vertices);
  for_ranges((tiles + step - 1) / step, kTilesAtOnce, [&](int first, int last) {
    const AlignedDoubles scratch =
        aligned_doubles(keeps ? 0 : static_cast<std::size_t>(kTilesTogether * per_tile));
    for (int begin = first; begin < last; begin += kTilesTogether) {
      const int count = std::min(kTilesTogether, last - begin);
      double* values = keeps ? rows_.get() + begin * per_tile : scratch.get();
      for (int i = 0; i < count; ++i) correlations((begin + i) * step, 1, values + i * per_tile);
      solve_triangle(*factor_, values, count, per_tile);
      for (int i = 0; i < count; ++i) {
        const int number = (begin + i) * step;
        double squares[kLanes] = {};
        add_sums(values + i * per_tile, rank(), nullptr, 0, 0, squares);
        for (int lane = 0; lane < tiles_->lanes(number); ++lane)
          residuals_[tiles_->vertices(number)[lane]] = 1.0 - squares[lane];
      }
    }
  });
  residual_ = std::max(residuals_.maxCoeff(), 4.0 * std::numeric_limits<double>::epsilon());
}

std::shared_ptr<const Features> Features::of(const Prior& prior, std::span<const Site> sites,
                                             double tolerance, int most,
                                             const std::shared_ptr<const Features>& known) {
  std::vector<Site> candidates = first_candidates(prior);
  const auto uncovered = [&](const Features& features) {
    std::vector<Site> places;
    for (const int vertex : worst(features.residuals_, tolerance))
      places.push_back(site_at(prior, prior.surface().at_vertex(vertex)));
    if (features.rows_) {
      for (const int site : worst(residuals_of(features.at(prior, sites)), tolerance))
        places.push_back(sites[site]);
    }
    return places;
  };
  std::vector<Site> missed;
  if (known) {
    missed = uncovered(*known);
    if (missed.empty()) return known;
  }
  for (int round = 0; round < kMostRounds; ++round) {
    candidates.insert(candidates.end(), missed.begin(), missed.end());
    // All anew: pivots must fall, since one that follows much smaller ones is made of their
    // rounding errors.
    auto features = std::make_shared<Features>();
    if (!features->choose_pivots(prior, candidates, tolerance, most)) return nullptr;
    if (round == 0) {
      features->visit_vertices(prior, kLookAhead);
      missed = uncovered(*features);
      if (!missed.empty()) continue;
    }
    features->visit_vertices(prior, 1);
    missed = uncovered(*features);
    if (missed.empty()) return features;
  }
  return nullptr;  // rounding leaves more
}

Eigen::VectorXd Features::at_vertex(int vertex) const {
  const int place = tiles_->place(vertex);
  return Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<kLanes>>(
      tile(place / kLanes) + place % kLanes, rank());
}

void Features::solve(Eigen::MatrixXd& columns) const {
  const long per_tile = static_cast<long>(rank()) * kLanes;
  const int tiles = static_cast<int>((columns.cols() + kLanes - 1) / kLanes);
  for_ranges(tiles, kTilesTogether, [&](int begin, int end) {
    const AlignedDoubles values =
        aligned_doubles(static_cast<std::size_t>(kTilesTogether * per_tile));
    for (int first = begin; first < end; first += kTilesTogether) {
      const int count = std::min(kTilesTogether, end - first);
      std::fill_n(values.get(), count * per_tile, 0.0);
      auto some = columns.middleCols(
          first * kLanes, std::min<Eigen::Index>(count * kLanes, columns.cols() - first * kLanes));
      const auto at = [&](Eigen::Index row, Eigen::Index column) -> double& {
        return values[column / kLanes * per_tile + row * kLanes + column % kLanes];
      };
      for (Eigen::Index column = 0; column < some.cols(); ++column) {
        for (Eigen::Index row = 0; row < rank(); ++row) at(row, column) = some(row, column);
      }
      solve_triangle(*factor_, values.get(), count, per_tile);
      for (Eigen::Index column = 0; column < some.cols(); ++column) {
        for (Eigen::Index row = 0; row < rank(); ++row) some(row, column) = at(row, column);
      }
    }
  });
}

Eigen::VectorXd Features::at(const Prior& prior, const Place& place) const {
  Eigen::MatrixXd column = correlations_with(prior, place, pivots_);
  solve(column);
  return column;
}

Eigen::MatrixXd Features::at(const Prior& prior, std::span<const Site> sites) const {
  Eigen::MatrixXd result(rank(), static_cast<Eigen::Index>(sites.size()));
  std::vector<Eigen::Index> inside_faces;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const int vertex = prior.surface().vertex_at(sites[i].where);
    if (vertex >= 0) {
      result.col(column) = at_vertex(vertex);
    } else {
      inside_faces.push_back(column);
    }
  }
  Eigen::MatrixXd solved(rank(), static_cast<Eigen::Index>(inside_faces.size()));
  for (std::size_t i = 0; i < inside_faces.size(); ++i)
    solved.col(i) = correlations_with(prior, sites[inside_faces[i]].place, pivots_);
  solve(solved);
  for (std::size_t i = 0; i < inside_faces.size(); ++i) result.col(inside_faces[i]) = solved.col(i);
  return result;
}

}  // namespace palpation
