#include "palpation/certainty/edge_belief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/normal.h"
#include "belief/sites.h"
#include "certainty/boundary_nodes.h"
#include "certainty/depth.h"
#include "certainty/edge_belief_fit.h"
#include "palpation/base/error.h"
#include "palpation/boundary/level_set.h"
#include "readings/rounding.h"

namespace palpation {
namespace {

/// Readings without noise still scatter about the profile, as much as the model of the edge is
/// wrong: a thousandth of the range.
constexpr double kModelError = 1e-3;
/// More places than this are many; beyond so deep an edge of any slope in the prior is over (98 %
/// at 500 per metre).
constexpr Eigen::Index kMany = 300;
constexpr double kDeep_m = 0.008;
/// Mean squared residual over noise variance: what chance makes of a hundred readings is less.
constexpr double kMuchScatter = 1.3;
/// And over those degrees of freedom that are the noise's: chance makes more of a hundred readings.
constexpr double kLittleScatter = 0.5;
constexpr int kMostRounds = 4;
/// Laplace's approximation takes the profile as straight. Where the boundary may be off by a good
/// part of the edge's width, readings tell less than that: the offset's variance grows by this much
/// for a standard deviation of 1 / slope (found on simulated tumours).
constexpr double kCurved = 3.0;
/// Its tails are heavier than a normal's: the band is this many times as wide where the mean
/// standard deviation is 1 / slope and the tumour as broad as given, as a sixth root less where the
/// edge is surer, and as a square root more where the tumour is slenderer, since a smooth field
/// takes narrow bends too wide. Both within what was simulated (found in the same way).
constexpr double kHeavyTail = 2.3;
constexpr double kBreadth_m = 0.005;
constexpr double kSurest = 0.03;
constexpr double kSlenderest_m = 0.004, kBroadest_m = 0.010;
/// Outlines are smoother than the correction's prior, which has corners. That overstates the wrong
/// area the more, the less the readings' noise adds: by this part where it adds nothing, fading as
/// the mean standard deviation grows past that part of 1 / slope (found in the same way).
constexpr double kSmoother = 0.3;
constexpr double kNoisePart = 0.1;

/// Gauss and Hermite's five nodes for the mean over a standard normal variable.
constexpr std::array<std::pair<double, double>, 5> kNormalNodes = {
    {{-2.856970013872806, 0.011257411327720691},
     {-1.355626179974266, 0.22207592200561266},
     {0.0, 8.0 / 15.0},
     {1.355626179974266, 0.22207592200561266},
     {2.856970013872806, 0.011257411327720691}}};

/// One reading per place, of those that are used.
EdgeData gathered(const Belief& belief) {
  EdgeData data;
  const std::vector<Site> sites = gather_sites(belief.prior(), belief.detrended_palpations());
  const auto count = static_cast<Eigen::Index>(sites.size());
  data.reading.resize(count);
  data.variance.resize(count);
  data.depth_m.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const MergedReading merged = merge(sites[i], belief.noise_variance());
    data.places.push_back(sites[i].where);
    data.reading[i] = merged.mean;
    data.variance[i] = merged.variance;
  }
  return data;
}

bool all_have_the_field_noise(std::span<const Palpation> palpations) {
  return std::ranges::all_of(palpations, [](const Palpation& one) {
    return std::isnan(one.noise_variance) || !one.set_aside.empty();
  });
}

std::vector<Vec3> places_of(const Layout& layout, std::span<const SurfacePoint> points) {
  std::vector<Vec3> places;
  for (const SurfacePoint& point : points) places.push_back(layout.at(point));
  return places;
}

/// Signed distances of the vertices and of the readings from { field = level }; false where there
/// is no boundary.
bool measure_depths(const Layout& layout, const Field& field, double level,
                    Eigen::VectorXd& vertices, EdgeData& data) {
  const Surface& surface = layout.surface();
  const std::vector<LevelLoop> loops = level_loops(surface, field, level);
  const std::vector<double> of_vertices = distances_from(layout, loops, layout.vertices());
  const std::vector<double> of_readings =
      distances_from(layout, loops, places_of(layout, data.places));
  if (of_vertices.empty() || of_readings.empty()) return false;
  vertices.resize(surface.vertex_count());
  for (Eigen::Index vertex = 0; vertex < vertices.size(); ++vertex) {
    const double distance = of_vertices[vertex];
    vertices[vertex] = field[vertex] >= level ? distance : -distance;
  }
  for (Eigen::Index i = 0; i < data.depth_m.size(); ++i) {
    const double distance = of_readings[i];
    data.depth_m[i] = surface.interpolate(field, data.places[i]) >= level ? distance : -distance;
  }
  return true;
}

/// Where there are many, the readings deep on one plateau as one, at their mean depth: they tell of
/// the plateau alone, and the fit costs the third power of their number.
EdgeData with_plateaus_merged(const EdgeData& data) {
  if (data.reading.size() <= kMany) return data;
  struct Plateau {
    std::optional<SurfacePoint> place;
    double precision = 0.0, reading = 0.0, depth_m = 0.0;
  };
  Plateau plateaus[2];
  EdgeData merged;
  std::vector<double> reading, variance, depth_m;
  for (Eigen::Index i = 0; i < data.reading.size(); ++i) {
    const SurfacePoint& place = data.places[i];
    if (std::abs(data.depth_m[i]) < kDeep_m) {
      merged.places.push_back(place);
      reading.push_back(data.reading[i]);
      variance.push_back(data.variance[i]);
      depth_m.push_back(data.depth_m[i]);
      continue;
    }
    Plateau& plateau = plateaus[data.depth_m[i] > 0.0];
    const double precision = 1.0 / data.variance[i];
    if (!plateau.place) plateau.place = place;
    plateau.precision += precision;
    plateau.reading += precision * data.reading[i];
    plateau.depth_m += precision * data.depth_m[i];
  }
  for (const Plateau& plateau : plateaus) {
    if (!plateau.place) continue;
    merged.places.push_back(*plateau.place);
    reading.push_back(plateau.reading / plateau.precision);
    variance.push_back(1.0 / plateau.precision);
    depth_m.push_back(plateau.depth_m / plateau.precision);
  }
  const auto vector_of = [](const std::vector<double>& values) {
    return Eigen::VectorXd(
        Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
  };
  merged.reading = vector_of(reading);
  merged.variance = vector_of(variance);
  merged.depth_m = vector_of(depth_m);
  return merged;
}

/// Squared residuals over the noise variance, their sum.
double squares(const EdgeFit& fit, const EdgeData& data) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < data.reading.size(); ++i) {
    const double residual =
        data.reading[i] - profile_reading(fit.profile, data.depth_m[i] + fit.correction_m[i]);
    sum += residual * residual / data.variance[i];
  }
  return sum;
}

/// The same fit where all noise variances are `times` as large.
EdgeFit refitted(const EdgeFit& fit, double times, EdgeData& data,
                 const Eigen::MatrixXd& prior_covariance, const ProfilePrior& prior) {
  data.variance *= times;
  EdgeFit next = fit_edge_belief(data, prior_covariance, prior);
  next.scatter = fit.scatter * times;
  return next;
}

/// Readings that scatter about the profile more than their noise says are believed that much less:
/// edges of real tissue are no perfect sigmoids. Where the noise was learned with the field, which
/// takes for noise what it cannot follow of a steep edge, those that scatter less are believed
/// more, as far as `least_variance`.
EdgeFit with_scatter(EdgeFit fit, EdgeData data, const Eigen::MatrixXd& prior_covariance,
                     const ProfilePrior& prior, bool noise_is_learned, double least_variance) {
  const Eigen::Index count = data.reading.size();
  for (int round = 0; noise_is_learned && round < kMostRounds; ++round) {
    // Of so many readings' worth of noise: what the fit has not followed (MacKay's measure).
    const double free =
        data.variance.dot(fit.covariance.solve(Eigen::MatrixXd::Identity(count, count)).diagonal());
    const double times =
        std::max(squares(fit, data) / free, least_variance / data.variance.minCoeff());
    if (!(times < kLittleScatter)) break;
    fit = refitted(fit, times, data, prior_covariance, prior);
  }
  for (int round = 0; round < kMostRounds; ++round) {
    const double scatter = squares(fit, data) / static_cast<double>(count);
    if (scatter < kMuchScatter) break;
    fit = refitted(fit, scatter, data, prior_covariance, prior);
  }
  return fit;
}

}  // namespace

double learned_noise_log_sd(int readings) {
  return readings > 0 ? 1.0 / std::sqrt(2.0 * readings) : 0.0;
}

EdgeBelief::EdgeBelief(Surface surface, std::shared_ptr<const Fit> fit)
    : surface_(std::move(surface)), fit_(std::move(fit)) {}

std::optional<EdgeBelief> EdgeBelief::around(const Belief& belief, const Marginals& component,
                                             std::span<const double> first_levels, double fraction,
                                             const ShapePrior& shape, double noise_log_sd) {
  require(fraction > 0.0 && fraction < 1.0, "EdgeBelief", "fraction = " + text_of(fraction),
          "must lie in (0, 1)");
  require(noise_log_sd >= 0.0, "EdgeBelief", "noise_log_sd = " + text_of(noise_log_sd),
          "must not be negative");
  const Surface& surface = belief.prior().surface();
  EdgeData all = gathered(belief);
  const double least = component.mean.minCoeff(), range = component.mean.maxCoeff() - least;
  if (all.places.empty() || !(range > 0.0)) return std::nullopt;
  const double model_variance = kModelError * kModelError * range * range;
  const double touch_variance = std::max(belief.noise_variance(), model_variance);
  all.variance = all.variance.cwiseMax(model_variance);

  const double plateau_variance = shape.plateau_error * shape.plateau_error * range * range;
  const ProfilePrior profile{
      {least, least + range, std::log(shape.slope_per_m)},
      {plateau_variance, plateau_variance, shape.slope_log_sd * shape.slope_log_sd}};
  const Kernel kernel{.family = KernelFamily::Matern52,
                      .length_m = shape.correction_length_m,
                      .signal_sd = shape.correction_sd_m};
  const Layout layout(belief.prior());
  // On a plane all metrics are one: the intrinsic one needs no waves there.
  const bool as_believed = surface.is_planar() && belief.prior().metric() != Metric::Intrinsic;
  const Prior correction(surface, as_believed ? belief.prior().metric() : layout.metric(), kernel,
                         Constant{.sd = 0.0});
  struct Start {
    EdgeData data;
    Eigen::MatrixXd prior_covariance;
    EdgeFit edge;
    Eigen::VectorXd distance;
  };
  std::optional<Start> best;
  for (const double first_level : first_levels) {
    Eigen::VectorXd distance;
    if (!measure_depths(layout, component.mean, first_level, distance, all)) continue;
    EdgeData data = with_plateaus_merged(all);
    Eigen::MatrixXd prior_covariance = correction.covariance(data.places, data.places);
    EdgeFit edge = fit_edge_belief(data, prior_covariance, profile);
    if (best && !(edge.log_evidence > best->edge.log_evidence)) continue;
    best =
        Start{std::move(data), std::move(prior_covariance), std::move(edge), std::move(distance)};
    if (all.reading.size() > kMany)
      break;  // what is merged differs from start to start, and so does the evidence
  }
  if (!best) return std::nullopt;
  const bool noise_is_learned = noise_log_sd > 0.0 && all_have_the_field_noise(belief.palpations());
  const EdgeFit edge = with_scatter(
      std::move(best->edge), best->data, best->prior_covariance, profile, noise_is_learned,
      std::max(model_variance, rounding_variance(belief.palpations())));
  EdgeBelief made(surface, std::make_shared<const Fit>(Fit{correction, profile, fraction,
                                                           touch_variance * edge.scatter,
                                                           best->data.places, edge}));
  made.noise_log_sd_ = noise_log_sd;
  made.profile_ = made.fit_->edge_profile();
  made.depth_ = made.fit_->depth_at_vertices(best->distance);
  made.survey_boundary();
  return made;
}

double EdgeBelief::noise_variance() const { return fit_->touch_variance; }

/// Offsets at nodes along the boundary: how sure they are, and how they go together.
void EdgeBelief::survey_boundary() {
  const BoundaryNodes nodes = boundary_nodes(surface_, depth_);
  const Eigen::MatrixXd covariance = fit_->depth_covariance(nodes.points);
  const Eigen::VectorXd as_if_straight = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  const Eigen::ArrayXd part_of_edge = as_if_straight.array() * profile_.slope_per_m;
  const Eigen::VectorXd sd =
      as_if_straight.array() * (1.0 + kCurved * part_of_edge.square()).sqrt();
  double length_m = 0.0;
  for (std::size_t i = 0; i < nodes.points.size(); ++i) {
    const auto here = static_cast<Eigen::Index>(i), before = here - 1;
    expected_error_m2_ += std::sqrt(2.0 / std::numbers::pi) * nodes.length_m[i] * sd[here];
    length_m += nodes.length_m[i];
    if (!nodes.follows_last[i]) continue;
    const double scale = as_if_straight[here] * as_if_straight[before];
    if (scale > 0.0) turn_ += std::acos(std::clamp(covariance(here, before) / scale, -1.0, 1.0));
  }
  if (sd.size() > 0) mean_part_of_edge_ = sd.mean() * profile_.slope_per_m;
  if (length_m > 0.0) breadth_m_ = 2.0 * superlevel_area(surface_, depth_, 0.0) / length_m;
  expected_error_m2_ *= 1.0 - kSmoother * std::exp(-mean_part_of_edge_ / kNoisePart);
  offset_sd_ = spread_from_nodes(Layout(fit_->correction), nodes, sd);
}

double EdgeBelief::band_score(double probability) const {
  const auto misses_at = [&](double q) {
    return 2.0 * (1.0 - normal_probability(q)) +
           2.0 * turn_ / (2.0 * std::numbers::pi) * std::exp(-0.5 * q * q);
  };
  const auto misses = [&](double q) {
    double sum = 0.0;
    for (const auto& [z, weight] : kNormalNodes)
      sum += weight * misses_at(q * std::exp(noise_log_sd_ * z));
    return sum;
  };
  double below = 0.0, above = 40.0;
  for (double middle = 20.0; below < middle && middle < above;
       middle = below + 0.5 * (above - below)) {
    (misses(middle) > 1.0 - probability ? below : above) = middle;
  }
  const double unsure = std::pow(std::max(mean_part_of_edge_, kSurest), 1.0 / 6.0);
  const double slender = std::sqrt(kBreadth_m / std::clamp(breadth_m_, kSlenderest_m, kBroadest_m));
  return kHeavyTail * unsure * slender * above;
}

}  // namespace palpation
