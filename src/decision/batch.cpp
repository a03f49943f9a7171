#include "palpation/decision/batch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <queue>
#include <string>

#include "decision/scoring.h"
#include "palpation/base/error.h"
#include "palpation/base/parallel.h"
#include "palpation/geometry/distance.h"
#include "palpation/geometry/path.h"

namespace palpation {
namespace {

constexpr int kGroup = 8;  // vertices that are evaluated together: what Belief stores together
/// With fewer readings the field is so unknown that lazy evaluation would come to every vertex anyway.
constexpr int kFewSites = 25;
/// Supposed readings on the way are this far apart: half the length over which stiffness changes; closer ones tell the same.
constexpr double kWayStep_m = 0.002;
constexpr double kNever = -std::numeric_limits<double>::infinity();

/// The variance at every vertex given the picks so far, brought up to date group by group when it is asked for.
///
///     e_k(x) = (c(x, x_k) - sum_{j<k} e_j(x) e_j(x_k)) / sqrt(var_k + noise),   variance(x) = variance_0(x) - sum_k e_k(x)^2,
///
/// c the posterior covariance: one row of a Cholesky factor for each pick.
class LookAhead {
 public:
  LookAhead(const Belief& belief, Field variance)
      : belief_(belief), variance_(std::move(variance)), groups_((static_cast<std::size_t>(variance_.size()) + kGroup - 1) / kGroup) {}

  std::size_t group_count() const { return groups_.size(); }
  std::size_t pick_count() const { return picks_.size(); }
  bool is_current(std::size_t group) const { return groups_[group].size() == picks_.size(); }

  double variance(int vertex) {
    bring_up_to_date(static_cast<std::size_t>(vertex) / kGroup);
    return variance_[vertex];
  }

  void bring_up_to_date(std::size_t group) {
    const int first = static_cast<int>(group) * kGroup;
    const int count = std::min(kGroup, static_cast<int>(variance_.size()) - first);
    for (std::size_t k = groups_[group].size(); k < picks_.size(); ++k) {
      std::array<double, kGroup> row{};
      (*picks_[k].covariance)(first, count, row.data());
      for (std::size_t j = 0; j < k; ++j) {
        for (int lane = 0; lane < count; ++lane) row[lane] -= groups_[group][j][lane] * picks_[k].earlier[j];
      }
      for (int lane = 0; lane < count; ++lane) {
        row[lane] *= picks_[k].scale;
        variance_[first + lane] = std::max(0.0, variance_[first + lane] - row[lane] * row[lane]);
      }
      groups_[group].push_back(row);
    }
  }

  void pick(int vertex) { read({vertex, belief_.noise_variance()}); }

  void read(const Supposed& reading) {
    const int vertex = reading.vertex;
    const double total = variance(vertex) + reading.noise_variance;
    Pick next{std::make_unique<CovarianceWith>(belief_, vertex), {}, total > 0.0 ? 1.0 / std::sqrt(total) : 0.0};
    for (const auto& row : groups_[static_cast<std::size_t>(vertex) / kGroup]) next.earlier.push_back(row[vertex % kGroup]);
    picks_.push_back(std::move(next));
  }

 private:
  struct Pick {
    std::unique_ptr<CovarianceWith> covariance;
    std::vector<double> earlier;  // e_j at this pick, j before it
    double scale;
  };

  const Belief& belief_;
  Field variance_;
  std::vector<Pick> picks_;
  std::vector<std::vector<std::array<double, kGroup>>> groups_;  // e_k of the picks applied so far
};

/// Which vertices may still be picked.
class Candidates {
 public:
  Candidates(const Surface& surface, std::span<const int> candidates, double least_spacing_m)
      : surface_(surface), least_spacing_m_(least_spacing_m), allowed_(static_cast<std::size_t>(surface.vertex_count()), false) {
    int previous = -1;
    for (int vertex : candidates) {
      require(vertex > previous && vertex < surface.vertex_count(), "choose_batch", "candidate " + std::to_string(vertex),
              "must be a vertex, greater than the one before");
      allowed_[vertex] = true;
      previous = vertex;
    }
  }

  bool allows(int vertex) const { return allowed_[vertex]; }

  void pick(int picked) {
    if (least_spacing_m_ == 0.0) return;
    for (const int vertex : vertices_near(surface_, picked, least_spacing_m_)) allowed_[vertex] = false;
  }

 private:
  const Surface& surface_;
  double least_spacing_m_;
  std::vector<bool> allowed_;
};

/// Where the probe has been when it comes to the next pick.
class Trail {
 public:
  Trail(const Belief& belief, const BatchOptions& options) : belief_(belief), way_reading_m_(options.way_reading_m) {
    if (options.from) places_.push_back(belief.prior().surface().position(*options.from));
  }

  /// The readings on the way to a pick, which is then a place of its own.
  std::vector<Supposed> on_the_way_to(int vertex) {
    const std::vector<Supposed> readings = supposed_on_the_way(belief_, places_, vertex, way_reading_m_);
    places_.push_back(belief_.prior().surface().vertex(vertex));
    return readings;
  }

 private:
  const Belief& belief_;
  double way_reading_m_;
  std::vector<Vec3> places_;
};

struct Best {
  double score = kNever;
  int vertex = -1;
};

struct Search {
  const PointwiseScorer& scorer;
  const Field& mean;
  LookAhead ahead;
  Candidates candidates;
  Trail trail;
  long evaluations = 0;

  Best best_of_group(std::size_t group) {
    ahead.bring_up_to_date(group);
    Best best;
    const int first = static_cast<int>(group) * kGroup;
    const int last = std::min(first + kGroup, static_cast<int>(mean.size()));
    for (int vertex = first; vertex < last; ++vertex) {
      if (!candidates.allows(vertex)) continue;
      ++evaluations;
      const double score = scorer(mean[vertex], ahead.variance(vertex));
      if (best.vertex < 0 || score > best.score) best = {score, vertex};
    }
    return best;
  }

  void pick(const Best& best, Batch& batch) {
    batch.vertices.push_back(best.vertex);
    batch.scores.push_back(best.score);
    for (const Supposed& reading : trail.on_the_way_to(best.vertex)) ahead.read(reading);
    ahead.pick(best.vertex);
    candidates.pick(best.vertex);
  }
};

void choose_exhaustively(Search& search, int size, Batch& batch) {
  while (static_cast<int>(batch.vertices.size()) < size) {
    Best best;
    for (std::size_t group = 0; group < search.ahead.group_count(); ++group) {
      const Best here = search.best_of_group(group);
      if (here.vertex >= 0 && (best.vertex < 0 || here.score > best.score)) best = here;
    }
    if (best.vertex < 0) return;
    search.pick(best, batch);
  }
}

/// A group's best score when it was last evaluated: an upper bound of what it is now.
struct Bound {
  double score;
  std::size_t group;
  int vertex;
  bool operator<(const Bound& other) const { return score < other.score || (score == other.score && group > other.group); }
};

void choose_lazily(Search& search, int size, Batch& batch) {
  std::priority_queue<Bound> bounds;
  const auto evaluate = [&](std::size_t group) {
    const Best best = search.best_of_group(group);
    if (best.vertex >= 0) bounds.push({best.score, group, best.vertex});
  };
  for (std::size_t group = 0; group < search.ahead.group_count(); ++group) evaluate(group);
  while (static_cast<int>(batch.vertices.size()) < size && !bounds.empty()) {
    const Bound top = bounds.top();
    bounds.pop();
    if (search.ahead.is_current(top.group)) {
      search.pick({top.score, top.vertex}, batch);
      evaluate(top.group);
    } else {
      evaluate(top.group);
    }
  }
}

/// A palpation that says what is believed already: it lowers the variance alone.
Palpation supposition(const Belief& belief, int vertex) {
  Palpation palpation;
  palpation.where = belief.prior().surface().at_vertex(vertex);
  palpation.reading = belief.at(std::span(&palpation.where, 1)).mean[0];
  return palpation;
}

Batch choose_whole(const Belief& belief, const Whole& acquisition, const Level& level, Candidates candidates, Trail trail, int size) {
  const Surface& surface = belief.prior().surface();
  Batch batch;
  Belief supposed = belief;
  while (static_cast<int>(batch.vertices.size()) < size) {
    const Field scores = acquisition.scores(supposed, level);
    require(scores.size() == surface.vertex_count(), "Acquisition", std::to_string(scores.size()) + " scores",
            "must be one for each vertex");
    Best best;
    for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
      if (!candidates.allows(vertex)) continue;
      require(!std::isnan(scores[vertex]), "Acquisition", "the score of vertex " + std::to_string(vertex), "must not be NaN");
      ++batch.evaluations;
      if (best.vertex < 0 || scores[vertex] > best.score) best = {scores[vertex], vertex};
    }
    if (best.vertex < 0) break;
    batch.vertices.push_back(best.vertex);
    batch.scores.push_back(best.score);
    candidates.pick(best.vertex);
    std::vector<Palpation> suppositions;
    for (const Supposed& reading : trail.on_the_way_to(best.vertex)) {
      suppositions.push_back(supposition(supposed, reading.vertex));
      suppositions.back().noise_variance = reading.noise_variance;
    }
    suppositions.push_back(supposition(supposed, best.vertex));
    supposed = supposed.condition_on(suppositions);
  }
  return batch;
}

}  // namespace

std::vector<Supposed> supposed_on_the_way(const Belief& belief, std::span<const Vec3> places, int vertex, double way_reading_m) {
  std::vector<Supposed> readings;
  if (way_reading_m == 0.0 || places.empty()) return readings;
  const Surface& surface = belief.prior().surface();
  const Vec3 end = surface.vertex(vertex);
  const Vec3 start = *std::ranges::min_element(places, {}, [&](const Vec3& place) { return (place - end).squaredNorm(); });
  const double length = (end - start).norm();
  // As many readings as will be made on so long a piece of the way.
  const double variance = belief.noise_variance() * way_reading_m / kWayStep_m;
  if (!surface.is_planar()) {
    const SurfacePoint begin = surface.at_vertex(surface.nearest_vertex(start));
    for (const SurfacePoint& place : way_between(surface, begin, surface.at_vertex(vertex), kWayStep_m)) {
      Eigen::Index nearest = 0;
      place.barycentric.maxCoeff(&nearest);
      readings.push_back({surface.triangle(place.face)[nearest], variance});
    }
    return readings;
  }
  for (double done = kWayStep_m; done < length; done += kWayStep_m) {
    readings.push_back({surface.nearest_vertex(start + done / length * (end - start)), variance});
  }
  return readings;
}

Batch choose_batch(const Belief& belief, const Acquisition& acquisition, const Level& level, std::span<const int> candidates,
                   const BatchOptions& options) {
  require(options.size >= 0, "choose_batch", "size = " + std::to_string(options.size), "must not be negative");
  require(std::isfinite(options.least_spacing_m) && options.least_spacing_m >= 0.0, "choose_batch",
          "least_spacing_m = " + text_of(options.least_spacing_m), "must be finite and not negative");
  require(std::isfinite(options.way_reading_m) && options.way_reading_m >= 0.0, "choose_batch",
          "way_reading_m = " + text_of(options.way_reading_m), "must be finite and not negative");
  Candidates allowed(belief.prior().surface(), candidates, options.least_spacing_m);
  if (const auto* whole = std::get_if<Whole>(&acquisition))
    return choose_whole(belief, *whole, level, std::move(allowed), Trail(belief, options), options.size);

  const auto& pointwise = std::get<Pointwise>(acquisition);
  require(options.evaluation != Evaluation::Lazy || pointwise.grows_with_stddev, "choose_batch", "lazy evaluation",
          "needs an acquisition that grows with stddev");
  const Marginals marginals = planning_marginals(belief);
  const PointwiseScorer scorer(pointwise, level, marginals, candidates);
  Search search{scorer, marginals.mean, LookAhead(belief, marginals.variance), std::move(allowed), Trail(belief, options)};
  const bool lazy = options.evaluation == Evaluation::Lazy ||
                    (options.evaluation == Evaluation::Automatic && pointwise.grows_with_stddev && belief.site_count() >= kFewSites);
  Batch batch;
  if (lazy) {
    choose_lazily(search, options.size, batch);
  } else {
    choose_exhaustively(search, options.size, batch);
  }
  batch.evaluations = search.evaluations;
  return batch;
}

}  // namespace palpation
