#include "palpation/certainty/outline_posterior.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "certainty/drawn_core.h"
#include "certainty/outline_core_start.h"
#include "certainty/outline_draws.h"
#include "certainty/outline_pruning.h"
#include "certainty/wandering.h"
#include "palpation/base/error.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

constexpr int kVerticesAtOnce = 256;
constexpr double kLeastSpread_m = 1e-6;
constexpr double kNormalFourth = 3.0;  ///< moment, over the variance's square
constexpr int kFewestDraws = 20;
/// Of what is felt where it is deepest: what reaches so much of that half way there levels off.
constexpr double kLevel = 0.9;

/// What part of a vertex's surroundings, so wide, is inside at this depth.
double share_inside(double depth_m, double width_m) {
  return std::clamp(depth_m / width_m + 0.5, 0.0, 1.0);
}

struct DrawnBoundary {
  Eigen::RowVectorXf depths;  ///< of places
  double level;               ///< of the first part
  bool has_plateau;           ///< the same
};
DrawnBoundary boundary_of(const OutlineDraw& draw, const Points2& places) {
  const OutlinePieces pieces(draw.outline);
  Eigen::RowVectorXf depths(places.rows());
  std::vector<int> part_of(static_cast<std::size_t>(places.rows()));
  struct Deepest {
    double depth_m = 0.0;
    Vec2 place = Vec2::Zero();
  };
  std::vector<Deepest> deepest(draw.profile.log_contrast.size());
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const Vec2 place = places.row(i).transpose();
    const auto [square, piece] = pieces.nearest(place);
    double depth = pieces.encloses(place) ? std::sqrt(square) : -std::sqrt(square);
    for (const Stadium& cut : draw.cuts) depth = std::min(depth, -cut.depth_at(place));
    const int part = draw.outline.loops[draw.outline.loop_of[piece]].part;
    if (depth > deepest[part].depth_m) deepest[part] = {depth, place};
    depths[i] = static_cast<float>(depth);
    part_of[i] = part;
  }
  std::vector<double> reached, share;  // of the contrast of each part, and that at its boundary
  for (const auto& [depth_m, place] : deepest) {
    reached.push_back(share_at(draw.law, depth_m, steepness_at(draw.law, place)));
    share.push_back((draw.has_plateau ? 1.0 : reached.back()) * share_at(draw.law, 0.0));
  }
  const auto& [deepest_m, middle] = deepest.front();
  const double half_way = share_at(draw.law, 0.5 * deepest_m, steepness_at(draw.law, middle));
  if (!draw.has_plateau) {
    for (Eigen::Index i = 0; i < places.rows(); ++i) {
      const double steepness = steepness_at(draw.law, places.row(i).transpose());
      depths[i] -= static_cast<float>(depth_where(draw.law, share[part_of[i]], steepness));
    }
  }
  return {depths, draw.law.low + draw.law.contrast.front() * share.front(),
          half_way >= kLevel * reached.front()};
}

struct DrawnBoundaries {
  Eigen::MatrixXf depths;  ///< rows are draws, columns vertices
  std::vector<double> levels;
  std::vector<double> has_plateau;  ///< 1 of those that have one, else 0
};
DrawnBoundaries boundaries_at(const Surface& surface, const std::vector<OutlineDraw>& draws) {
  DrawnBoundaries all{{static_cast<Eigen::Index>(draws.size()), surface.vertex_count()},
                      std::vector(draws.size(), 0.0),
                      std::vector(draws.size(), 0.0)};
  for_ranges(static_cast<int>(draws.size()), 1, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      const DrawnBoundary one = boundary_of(draws[i], surface.chart().uv);
      all.depths.row(i) = one.depths;
      all.levels[i] = one.level;
      all.has_plateau[i] = one.has_plateau;
    }
  });
  return all;
}

/// Median of the depths at each vertex: inside where more than half of them are.
Field median_depth(const Eigen::MatrixXf& depths) {
  const Eigen::Index vertices = depths.cols(), draws = depths.rows();
  Field median(vertices);
  for_ranges(static_cast<int>(vertices), kVerticesAtOnce, [&](int first, int last) {
    Eigen::VectorXf here(draws);
    for (int vertex = first; vertex < last; ++vertex) {
      here = depths.col(vertex);
      const auto middle = here.begin() + (draws - 1) / 2;
      std::nth_element(here.begin(), middle, here.end());
      median[vertex] = *middle;
    }
  });
  return median;
}

/// How far each draw's outline, where it crosses the mesh's edges, lies from a boundary.
std::vector<double> farthest_from(const Surface& surface, const Eigen::MatrixXf& depths,
                                  const Field& score) {
  std::vector<double> farthest(static_cast<std::size_t>(depths.rows()), 0.0);
  for (int face = 0; face < surface.face_count(); ++face) {
    const Eigen::Vector3i corners = surface.triangle(face);
    for (int i = 0; i < 3; ++i) {
      const int a = corners[i], b = corners[(i + 1) % 3];
      for (Eigen::Index draw = 0; draw < depths.rows(); ++draw) {
        const double at_a = depths(draw, a), at_b = depths(draw, b);
        if ((at_a >= 0.0) == (at_b >= 0.0)) continue;
        const double here = score[a] + at_a / (at_a - at_b) * (score[b] - score[a]);
        farthest[draw] = std::max(farthest[draw], std::abs(here));
      }
    }
  }
  return farthest;
}

/// Of each chain's draws, from the boundary of the other's: from their own, which few that are
/// alike make, they would be nearer than fresh ones.
std::vector<double> farthest_of(const Surface& surface, const Eigen::MatrixXf& depths,
                                const Field& spread) {
  const Eigen::Index half = depths.rows() / kChains;
  std::vector<double> farthest;
  for (int chain = 0; chain < kChains; ++chain) {
    const Field others = median_depth(depths.middleRows((1 - chain) * half, half));
    const std::vector<double> of_chain =
        farthest_from(surface, depths.middleRows(chain * half, half), others.cwiseQuotient(spread));
    farthest.insert(farthest.end(), of_chain.begin(), of_chain.end());
  }
  std::ranges::sort(farthest);
  return farthest;
}

double mean_edge_m(const Surface& surface) {
  return std::sqrt(2.0 * surface.area() / surface.face_count());
}

/// Over each vertex and its neighbours: of faces' means the mean.
Field mean_around(const Surface& surface, const Field& values) {
  Field sum = Field::Zero(values.size());
  Field faces = Field::Zero(values.size());
  for (int face = 0; face < surface.face_count(); ++face) {
    const Eigen::Vector3i corners = surface.triangle(face);
    sum(corners).array() += values(corners).mean();
    faces(corners).array() += 1.0;
  }
  return sum.cwiseQuotient(faces);
}

/// Of the depths at each vertex, by their fourth moment: a standard deviation where they are
/// normal, more where some lie far off, which is what a band of the whole outline has to hold. It
/// changes slowly from vertex to vertex: the score is linear between them, and where one was
/// divided by twice as much as the next, it would be zero beside the boundary.
Field spread_of(const Surface& surface, const Eigen::MatrixXf& depths) {
  Field fourth(depths.cols());
  for_ranges(static_cast<int>(depths.cols()), kVerticesAtOnce, [&](int first, int last) {
    for (int vertex = first; vertex < last; ++vertex) {
      const Eigen::ArrayXd here = depths.col(vertex).cast<double>();
      fourth[vertex] = (here - here.mean()).square().square().mean();
    }
  });
  return (mean_around(surface, fourth).array() / kNormalFourth).pow(0.25).max(kLeastSpread_m);
}

/// What of the region and of the draws does not overlap, and the draws' areas.
void add_areas(const Surface& surface, const Eigen::MatrixXf& depths, OutlinePosterior& posterior) {
  const double width = mean_edge_m(surface);
  const Eigen::Index draws = depths.rows();
  std::vector<double> areas(static_cast<std::size_t>(draws), 0.0);
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    const double area = surface.vertex_areas()[vertex],
                 found = share_inside(posterior.depth[vertex], width);
    for (Eigen::Index draw = 0; draw < draws; ++draw) {
      const double drawn = share_inside(depths(draw, vertex), width);
      areas[draw] += area * drawn;
      posterior.expected.missed_m2 +=
          area * std::max(drawn - found, 0.0) / static_cast<double>(draws);
      posterior.expected.extra_m2 +=
          area * std::max(found - drawn, 0.0) / static_cast<double>(draws);
    }
  }
  posterior.area_m2 = summed_up(std::move(areas));
}

Level mean_and_sd(const std::vector<double>& numbers) {
  const Eigen::Map<const Eigen::ArrayXd> all(numbers.data(), std::ssize(numbers));
  const double mean = all.mean();
  return {mean, std::sqrt((all - mean).square().mean())};
}

double mean_noise(const std::vector<OutlineDraw>& draws) {
  double sum = 0.0;
  for (const OutlineDraw& draw : draws) sum += std::exp(draw.log_noise);
  return sum / static_cast<double>(draws.size());
}

DrawnNumber noise_inside(const std::vector<OutlineDraw>& draws) {
  std::vector<double> times;
  for (const OutlineDraw& draw : draws) times.push_back(std::exp(draw.noise_growth));
  return summed_up(std::move(times));
}

std::vector<ChangeLeft> left_of(const std::vector<Misfit>& changes,
                                const std::vector<OutlineDraw>& draws) {
  std::vector<ChangeLeft> left;
  Eigen::Index step = 0;
  for (std::size_t change = 0; change < changes.size(); ++change) {
    if (is_displacement(changes[change])) continue;
    std::vector<double> steps, gains;
    for (const OutlineDraw& draw : draws) {
      steps.push_back(moves_zero(changes[change]) ? draw.steps[step] : 0.0);
      gains.push_back(std::exp(draw.profile.log_gain[change]));
    }
    step += moves_zero(changes[change]);
    left.push_back({changes[change], mean_and_sd(steps), summed_up(std::move(gains))});
  }
  return left;
}

/// A core that is not the same however one comes to it is not all that is drawn.
OutlineDraws drawn_from(const ChainStarts& starts, const OutlineStart& plain,
                        const OutlineOptions& options) {
  OutlineDraws drawn = draws_from(starts, options.draws, options.seed);
  if (!starts.of.front().profile.core || drawn.misfit.do_agree()) return drawn;
  return draws_from({{plain, starts.of.front()}, starts.least_area_m2}, options.draws,
                    options.seed);
}

/// Where places may wander, with ways; without, where these do not matter after all.
OutlineDraws drawn_wandering(const OutlineStart& plain, const Surface& surface, const Field& mean,
                             const OutlineOptions& options) {
  const ChainStarts starts = with_core_if_paid(plain, surface, mean, options.seed);
  const ReadingWays ways = ways_of(plain.readings.made);
  ChainStarts wandering = starts;
  for (OutlineStart& start : wandering.of) let_wander(ways, start);
  if (do_places_wander(wandering.of.front(), options.seed)) {
    OutlineStart plain_wandering = plain;
    let_wander(ways, plain_wandering);
    OutlineDraws drawn = drawn_from(wandering, plain_wandering, options);
    drawn.misfit.wandering = wandering_by(drawn.draws, plain_wandering.readings);
    if (drawn.misfit.wandering->may_matter()) return drawn;
  }
  return drawn_from(starts, plain, options);
}

}  // namespace

double OutlinePosterior::band_score(double probability) const {
  require(probability > 0.0 && probability < 1.0, "band_score",
          "probability = " + text_of(probability), "must lie in (0, 1)");
  const auto count = static_cast<double>(farthest.size());
  const double rank = std::ceil(probability * (count + 1.0));  // as a fresh draw would fall
  return farthest[static_cast<std::size_t>(std::clamp(rank, 1.0, count)) - 1];
}

bool OutlinePosterior::core_matters() const {
  return core && (core->probability == 1.0 ||
                  std::abs(core->with_m2 - core->without_m2) > expected.symmetric_difference_m2());
}

std::optional<OutlinePosterior> sample_outlines(const Belief& belief, const EdgeBelief& edge,
                                                const OutlineOptions& options) {
  require(options.fraction > 0.0 && options.fraction < 1.0, "sample_outlines",
          "fraction = " + text_of(options.fraction), "must lie in (0, 1)");
  require(options.draws >= kFewestDraws, "sample_outlines",
          "draws = " + std::to_string(options.draws),
          "must be at least " + std::to_string(kFewestDraws));
  const Surface& surface = belief.prior().surface();
  if (!surface.has_chart()) return std::nullopt;
  const Field mean = belief.at_vertices(Part::Detrended).mean;
  std::optional<OutlineStart> first = outline_start(belief, mean, edge, options);
  if (!first) return std::nullopt;
  const auto [draws, misfit] =
      drawn_wandering(pruned(*std::move(first), options.seed), surface, mean, options);
  const auto [depths, levels, has_plateau] = boundaries_at(surface, draws);
  OutlinePosterior posterior{.depth = median_depth(depths),
                             .spread = spread_of(surface, depths),
                             .farthest = {},
                             .expected = {},
                             .area_m2 = {},
                             .left = left_of(options.changes, draws),
                             .noise = mean_noise(draws),
                             .noise_inside = noise_inside(draws),
                             .level = mean_and_sd(levels),
                             .core = core_of(surface, draws, depths),
                             .plateau_probability = mean_and_sd(has_plateau).value,
                             .misfit = misfit};
  add_areas(surface, depths, posterior);
  posterior.farthest = farthest_of(surface, depths, posterior.spread);
  return posterior;
}

}  // namespace palpation
