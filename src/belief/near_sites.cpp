// Variances that are all but nothing: at a site that was read with little noise, and beside it.
// There 1 - v'v is a difference of equals. With e the site's unit vector, g = L^-1 e and d its
// noise, the posterior covariance of the field at the site with anything of prior covariance k is d
// g'(L^-1 k), so that without a difference
//
//     variance at the site = d (1 - d g'g),
//     variance beside it   = that + 2 d g'w + 2 (1 - k(x, p)) - w'w,  w = L^-1 (k(., x) - k(., p)),
//
// the second from the increment f(x) - f(p), whose own prior variance 2 (1 - k) and covariances are
// small from the start.

#include <algorithm>
#include <cmath>

#include "belief/correlations.h"
#include "belief/exact_engine.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

/// An increment is small where a correlation is above this: within 0.3 lengths for the squared
/// exponential.
constexpr double kBeside = 0.95;
/// Vertices of less variance than this are looked at again: above it 1 - v'v is good to eight
/// digits.
constexpr double kSmallVariance = 1e-6;

/// `is_small`: the noise d.
double at_site(double d, bool is_small, double square, double plain) {
  const double known = d * square;
  return is_small || known < 0.5 ? d * (1.0 - known) : plain;
}

}  // namespace

/// With all the digits that the place's coordinates have.
Seen ExactEngine::look_at(const Prior& prior, const Place& place) const {
  const Eigen::VectorXd k = correlations_with(prior, place, sites_);
  const Eigen::VectorXd v = solve_lower(k);
  Seen seen{1.0 - v.squaredNorm(), v.dot(whitened_.ones), v.dot(whitened_.readings), Vec3::Zero()};
  if (prior.has_slope()) seen.tilts = whitened_.tilts.transpose() * v;
  if (sites_.empty()) return seen;
  Eigen::Index site = 0;
  if (k.maxCoeff(&site) < kBeside) return seen;
  const double d = diagonal_[site];
  const bool same = place == sites_[site].place;
  if (!same && (prior.metric() == Metric::Intrinsic || seen.unexplained > 0.01)) return seen;
  const Eigen::VectorXd g = solve_lower(Eigen::VectorXd::Unit(k.size(), site));
  const double there = at_site(d, d < kSmallNoise, g.squaredNorm(), seen.unexplained);
  if (same) {
    seen.unexplained = there;
    return seen;
  }
  if (d >= kSmallNoise) return seen;
  const Vec3& p = sites_[site].place.coordinates;
  Eigen::VectorXd change(k.size());
  for (Eigen::Index i = 0; i < k.size(); ++i)
    change[i] =
        correlation_change(prior.kernel(), p - sites_[i].place.coordinates, place.coordinates - p);
  const Eigen::VectorXd w = solve_lower(std::move(change));
  seen.unexplained = there + 2.0 * d * g.dot(w) +
                     2.0 * decorrelation(prior.kernel(), place.coordinates - p) - w.squaredNorm();
  return seen;
}

/// 1 - sum V^2 at the vertices, restated where too few of its digits are left; empty where all have
/// enough.
void ExactEngine::sharpen(const Prior& prior) {
  sharp_.resize(0);
  if (sites_.empty() || least_noise_ >= kSmallNoise) return;
  const VertexTiles& tiles = prior.tiles();
  sharp_.resize(tiles.vertex_count());
  Field covered(tiles.vertex_count());
  for (int vertex = 0; vertex < tiles.vertex_count(); ++vertex) {
    sharp_[vertex] = 1.0 - sums_->at(tiles.place(vertex), VertexSums::kExplained);
    covered[vertex] = sums_->at(tiles.place(vertex), sums_->covered());
  }
  std::vector<Eigen::VectorXd> g(sites_.size()), v(sites_.size());
  std::vector<double> there(sites_.size());
  for_ranges(static_cast<int>(sites_.size()), 4, [&](int first, int last) {
    for (int site = first; site < last; ++site) {
      if (diagonal_[site] >= kSmallNoise) continue;
      g[site] = solve_lower(Eigen::VectorXd::Unit(row_count(), site));
      v[site] = solve_lower(correlations_with(prior, sites_[site].place, sites_));
      there[site] = at_site(diagonal_[site], true, g[site].squaredNorm(), 0.0);
    }
  });
  if (prior.metric() != Metric::Intrinsic) sharpen_beside(prior, g, v, there);
  for (std::size_t site = 0; site < sites_.size(); ++site) {
    const int vertex = prior.surface().vertex_at(sites_[site].where);
    if (vertex >= 0 && diagonal_[site] < kSmallNoise) sharp_[vertex] = there[site];
  }
  if (least_noise_ > 0.0)
    sharp_ = sharp_.array().max(least_noise_ / (least_noise_ + covered.array()));
  sharp_ = sharp_.array().max(0.0).min(1.0);
}

/// The vertices beside sites, `g` and `v` of each, from the variance at them.
void ExactEngine::sharpen_beside(const Prior& prior, std::span<const Eigen::VectorXd> g,
                                 std::span<const Eigen::VectorXd> v,
                                 std::span<const double> there) {
  const VertexTiles& tiles = prior.tiles();
  for_ranges(static_cast<int>(sharp_.size()), 512, [&](int first, int last) {
    for (int vertex = first; vertex < last; ++vertex) {
      if (sharp_[vertex] > kSmallVariance) continue;
      const Vec3 x = prior.coordinates(vertex);
      std::size_t site = 0;
      for (std::size_t i = 1; i < sites_.size(); ++i) {
        if ((sites_[i].place.coordinates - x).squaredNorm() <
            (sites_[site].place.coordinates - x).squaredNorm())
          site = i;
      }
      const double apart = decorrelation(prior.kernel(), x - sites_[site].place.coordinates);
      if (diagonal_[site] >= kSmallNoise || apart > 1.0 - kBeside) continue;
      double along = 0.0, square = 0.0;
      for (const auto& rows : rows_) {
        for (int row = 0; row < rows->count; ++row) {
          const double w = rows->value(row, tiles.place(vertex)) - v[site][rows->first + row];
          along += g[site][rows->first + row] * w;
          square += w * w;
        }
      }
      sharp_[vertex] = there[site] + 2.0 * diagonal_[site] * along + 2.0 * apart - square;
    }
  });
}

}  // namespace palpation
