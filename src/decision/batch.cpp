#include "palpation/decision/batch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "belief/look_ahead.h"
#include "decision/scoring.h"
#include "palpation/base/error.h"
#include "palpation/geometry/distance.h"
#include "palpation/geometry/path.h"

namespace palpation {
namespace {

/// Supposed readings on the way are this far apart: half the length over which stiffness changes;
/// closer ones tell the same.
constexpr double kWayStep_m = 0.002;
constexpr double kNever = -std::numeric_limits<double>::infinity();

/// Which vertices may still be picked.
class Candidates {
 public:
  Candidates(const Surface& surface, std::span<const int> candidates, double least_spacing_m)
      : surface_(surface),
        least_spacing_m_(least_spacing_m),
        allowed_(static_cast<std::size_t>(surface.vertex_count()), 0) {
    int previous = -1;
    const int count = surface.vertex_count();
    for (int vertex : candidates) {
      if (vertex <= previous || vertex >= count) {  // no words for the many that are right
        require(false, "choose_batch", "candidate " + std::to_string(vertex),
                "must be a vertex, greater than the one before");
      }
      allowed_[vertex] = 1;
      previous = vertex;
    }
  }

  bool allows(int vertex) const { return allowed_[vertex] != 0; }

  void pick(int picked) {
    if (least_spacing_m_ == 0.0) return;
    for (const int vertex : vertices_near(surface_, picked, least_spacing_m_)) allowed_[vertex] = 0;
  }

 private:
  const Surface& surface_;
  double least_spacing_m_;
  std::vector<char> allowed_;
};

/// Where the probe has been when it comes to the next pick.
class Trail {
 public:
  Trail(const Belief& belief, const BatchOptions& options)
      : belief_(belief), way_reading_m_(options.way_reading_m) {
    if (options.from) places_.push_back(belief.prior().surface().position(*options.from));
  }

  /// The readings on the way to a pick, which is then a place of its own.
  std::vector<Supposed> on_the_way_to(int vertex) {
    const std::vector<Supposed> readings =
        supposed_on_the_way(belief_, places_, vertex, way_reading_m_);
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

  bool is_none() const { return vertex < 0; }
  bool operator<(const Best& other) const {
    return score < other.score || (score == other.score && vertex > other.vertex);
  }
};

struct Search {
  const PointwiseScorer& scorer;
  const Field& mean;
  double noise_variance;
  LookAhead ahead;
  Candidates candidates;
  Trail trail;
  long evaluations = 0;

  /// Of a tile's vertices, by what is known of them now.
  Best best_of(int tile) {
    if (!ahead.is_current(tile)) ahead.bring_up_to_date(tile);
    const std::span<const int> vertices = ahead.vertices(tile);
    const double* variance = ahead.variances(tile);
    Best best;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const int vertex = vertices[i];
      if (!candidates.allows(vertex)) continue;
      ++evaluations;
      const double score = scorer(mean[vertex], variance[i]);
      if (best.vertex < 0 || score > best.score || (score == best.score && vertex < best.vertex))
        best = {score, vertex};
    }
    return best;
  }

  void pick(const Best& best, Batch& batch) {
    batch.vertices.push_back(best.vertex);
    batch.scores.push_back(best.score);
    for (const Supposed& reading : trail.on_the_way_to(best.vertex))
      ahead.touch(reading.vertex, reading.noise_variance);
    ahead.touch(best.vertex, noise_variance);
    candidates.pick(best.vertex);
  }
};

void choose_exhaustively(Search& search, int size, Batch& batch) {
  while (static_cast<int>(batch.vertices.size()) < size) {
    Best best;
    for (int tile = 0; tile < search.ahead.tile_count(); ++tile) {
      const Best here = search.best_of(tile);
      if (!here.is_none() && (best.is_none() || best < here)) best = here;
    }
    if (best.is_none()) return;
    search.pick(best, batch);
  }
}

/// A tile's best when it was last evaluated: an upper bound of what it is now.
struct Bound {
  Best best;
  int tile;
  bool operator<(const Bound& other) const { return best < other.best; }
};

void choose_lazily(Search& search, int size, Batch& batch) {
  std::vector<Bound> bounds;
  bounds.reserve(search.ahead.tile_count());
  for (int tile = 0; tile < search.ahead.tile_count(); ++tile) {
    const Best best = search.best_of(tile);
    if (!best.is_none()) bounds.push_back({best, tile});
  }
  std::make_heap(bounds.begin(), bounds.end());
  while (static_cast<int>(batch.vertices.size()) < size && !bounds.empty()) {
    std::pop_heap(bounds.begin(), bounds.end());
    Bound& top = bounds.back();
    if (search.ahead.is_current(top.tile)) search.pick(top.best, batch);
    top.best = search.best_of(top.tile);
    if (top.best.is_none()) {
      bounds.pop_back();
    } else {
      std::push_heap(bounds.begin(), bounds.end());
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

Batch choose_whole(const Belief& belief, const Whole& acquisition, const Level& level,
                   Candidates candidates, Trail trail, int size) {
  const Surface& surface = belief.prior().surface();
  Batch batch;
  Belief supposed = belief;
  while (static_cast<int>(batch.vertices.size()) < size) {
    const Field scores = acquisition.scores(supposed, level);
    require(scores.size() == surface.vertex_count(), "Acquisition",
            std::to_string(scores.size()) + " scores", "must be one for each vertex");
    Best best;
    for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
      if (!candidates.allows(vertex)) continue;
      require(!std::isnan(scores[vertex]), "Acquisition",
              "the score of vertex " + std::to_string(vertex), "must not be NaN");
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

std::vector<Supposed> supposed_on_the_way(const Belief& belief, std::span<const Vec3> places,
                                          int vertex, double way_reading_m) {
  std::vector<Supposed> readings;
  if (way_reading_m == 0.0 || places.empty()) return readings;
  const Surface& surface = belief.prior().surface();
  const Vec3 end = surface.vertex(vertex);
  const Vec3 start = *std::ranges::min_element(
      places, {}, [&](const Vec3& place) { return (place - end).squaredNorm(); });
  const double length = (end - start).norm();
  // As many readings as will be made on so long a piece of the way.
  const double variance = belief.noise_variance() * way_reading_m / kWayStep_m;
  if (!surface.is_planar()) {
    const SurfacePoint begin = surface.at_vertex(surface.nearest_vertex(start));
    for (const SurfacePoint& place :
         way_between(surface, begin, surface.at_vertex(vertex), kWayStep_m)) {
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

Batch choose_batch(const Belief& belief, const Acquisition& acquisition, const Level& level,
                   std::span<const int> candidates, const BatchOptions& options) {
  require(options.size >= 0, "choose_batch", "size = " + std::to_string(options.size),
          "must not be negative");
  require(std::isfinite(options.least_spacing_m) && options.least_spacing_m >= 0.0, "choose_batch",
          "least_spacing_m = " + text_of(options.least_spacing_m),
          "must be finite and not negative");
  require(std::isfinite(options.way_reading_m) && options.way_reading_m >= 0.0, "choose_batch",
          "way_reading_m = " + text_of(options.way_reading_m), "must be finite and not negative");
  Candidates allowed(belief.prior().surface(), candidates, options.least_spacing_m);
  if (const auto* whole = std::get_if<Whole>(&acquisition))
    return choose_whole(belief, *whole, level, std::move(allowed), Trail(belief, options),
                        options.size);

  const auto& pointwise = std::get<Pointwise>(acquisition);
  require(options.evaluation != Evaluation::Lazy || pointwise.grows_with_stddev, "choose_batch",
          "lazy evaluation", "needs an acquisition that grows with stddev");
  const Marginals marginals = planning_marginals(belief);
  const PointwiseScorer scorer(pointwise, level, marginals, candidates);
  Search search{scorer,
                marginals.mean,
                belief.noise_variance(),
                LookAhead(belief, marginals.variance),
                std::move(allowed),
                Trail(belief, options)};
  const bool lazy = options.evaluation == Evaluation::Lazy ||
                    (options.evaluation == Evaluation::Automatic && pointwise.grows_with_stddev);
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
