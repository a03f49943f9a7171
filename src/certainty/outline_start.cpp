#include "certainty/outline_start.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>

#include "certainty/edge_data.h"
#include "certainty/errors_in_turn.h"
#include "certainty/outline_lines.h"
#include "certainty/slow_waves.h"
#include "certainty/wild_readings.h"
#include "palpation/geometry/chart_place.h"
#include "readings/rounding.h"

namespace palpation {
namespace {

constexpr double kTurn = 0.12;  ///< radians a piece, of the prior's median
/// Of how large an outline is: what nobody knows is within e times as wide or as narrow.
constexpr double kMostSizeLogSd = 1.0;
/// Of a noise that is given: edges are no perfect sigmoids.
constexpr double kGivenNoiseLogSd = 0.3;
constexpr double kLearnedNoiseLogSd = 1.0;
constexpr double kWaves = 0.02, kDrift = 0.1,
                 kTilt = 0.2;         ///< sd of the background's, of the range
constexpr double kTravel_m = 0.001;   ///< a direction of travel is that of so long a way
constexpr double kStep = 0.25;        ///< sd of what is left of a zero's step, of the range
constexpr double kSessionStep = 1.0;  ///< where another session began: it may have felt one plateau
/// Of what is left of a gain, and of a session's, of which nothing was taken back.
constexpr double kGainLogSd = 0.2, kSessionGainLogSd = 0.5;

/// The changes that most of the readings that are one were made after.
std::vector<int> changes_before(std::span<const Misfit> changes, const std::vector<Made>& made) {
  std::vector<int> before;
  for (std::size_t change = 0; change < changes.size(); ++change) {
    const auto since = std::ranges::count_if(
        made, [&](const Made& one) { return is_since(changes[change], one); });
    if (2 * since > std::ssize(made)) before.push_back(static_cast<int>(change));
  }
  return before;
}

/// Columns for those that move the zero.
Eigen::MatrixXd steps_of(std::span<const Misfit> changes,
                         const std::vector<std::vector<int>>& before) {
  Eigen::MatrixXd steps(static_cast<Eigen::Index>(before.size()), 0);
  for (std::size_t change = 0; change < changes.size(); ++change) {
    if (!moves_zero(changes[change])) continue;
    steps.conservativeResize(Eigen::NoChange, steps.cols() + 1);
    for (Eigen::Index row = 0; row < steps.rows(); ++row)
      steps(row, steps.cols() - 1) =
          static_cast<double>(std::ranges::count(before[row], static_cast<int>(change)));
  }
  return steps;
}

/// Each reading's, among those that there are: the first knows of no change.
std::vector<int> epochs_of(const std::vector<std::vector<int>>& before,
                           std::vector<std::vector<int>>& epochs) {
  std::vector<int> of_readings;
  for (const std::vector<int>& changes : before) {
    const auto found = std::ranges::find(epochs, changes);
    of_readings.push_back(static_cast<int>(found - epochs.begin()));
    if (found == epochs.end()) epochs.push_back(changes);
  }
  return of_readings;
}

Eigen::VectorXd step_sd_of(std::span<const Misfit> changes, double range) {
  std::vector<double> sd;
  for (const Misfit& change : changes) {
    if (moves_zero(change)) sd.push_back(range * (change.session > 0 ? kSessionStep : kStep));
  }
  return Eigen::Map<const Eigen::VectorXd>(sd.data(), static_cast<Eigen::Index>(sd.size()));
}

/// What each adds; no columns where there are none.
Eigen::MatrixXd slow_waves_of(const Layout& layout, const std::optional<WaveScale>& waves,
                              std::span<const SurfacePoint> places) {
  if (!waves || places.empty()) return {};
  return waves->sd * SlowWaves(layout.surface(), layout.metric(), waves->length_m, places).terms();
}

/// What each adds, of a height that was seen: slow waves and errors that last.
Eigen::MatrixXd seen_terms(const Layout& layout, const SeenBackground& seen,
                           std::span<const SurfacePoint> places,
                           std::span<const std::vector<Made>> made) {
  const Eigen::MatrixXd waves = slow_waves_of(layout, seen.slow_waves, places);
  const LastingErrors& lasting = seen.errors_in_turn;
  if (!(lasting.readings > 0.0)) return waves;
  const Eigen::MatrixXd errors =
      lasting.sd * terms_of_errors(made, lasting.readings, kMostOfOneKind);
  Eigen::MatrixXd both(errors.rows(), waves.cols() + errors.cols());
  if (waves.cols() > 0) both.leftCols(waves.cols()) = waves;
  both.rightCols(errors.cols()) = errors;
  return both;
}

/// Of readings that are one: that of any.
Bound bound_of(const std::vector<Made>& made) {
  for (const Made& one : made) {
    if (one.bound != Bound::None) return one.bound;
  }
  return Bound::None;
}

/// In the chart, from where the probe came: there it was on the tissue.
std::vector<Vec2> travel_in_plane(const Surface& surface, std::span<const SurfacePoint> places,
                                  std::span<const std::vector<Made>> made) {
  std::vector<Vec2> travel;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec3 before = surface.position(places[i]) - kTravel_m * travel_to(made[i]);
    travel.push_back(
        (chart_place(surface, places[i]) - chart_place(surface, surface.project(before))) /
        kTravel_m);
  }
  return travel;
}

void set_heights(BackgroundTerms& background, std::span<const Misfit> changes, double range) {
  background.step_sd = step_sd_of(changes, range);
  background.median_sd = kWaves * range;
  background.drift_sd = kDrift * range;
  background.tilt_sd = kTilt * range;
}

OutlineReadings readings_in_plane(const Belief& belief, const EdgeBelief& edge, double range,
                                  const OutlineOptions& options, double profile_error,
                                  OutlinePrior& prior) {
  const std::vector<Misfit>& changes = options.changes;
  const Surface& surface = belief.prior().surface();
  const Layout layout(belief.prior());
  EdgeData data = options.one_by_one.empty() ? gathered_for_edge(belief)
                                             : gathered_for_edge(belief, options.one_by_one);
  const SeenBackground& seen = options.background;
  if (seen.errors_in_turn.readings > 0.0 && seen.drift.size() > 0)
    data.reading += mean_in_turn(seen.drift, data.made);
  data.variance = data.variance.cwiseMax(profile_error);
  const double least_variance = std::max(profile_error, rounding_variance(belief.palpations()));
  prior.residuals.least_log_noise = 0.5 * std::log(least_variance / data.variance.minCoeff());
  Eigen::VectorXd of_vertices;
  if (measure_depths(layout, edge.depth(), 0.0, of_vertices, data))
    data = with_plateaus_merged(layout, data);
  std::vector<std::size_t> order(data.places.size());
  std::iota(order.begin(), order.end(), 0);
  std::vector<Vec2> places;
  for (const SurfacePoint& place : data.places) places.push_back(chart_place(surface, place));
  std::ranges::sort(order, {}, [&](std::size_t i) {
    const auto row = static_cast<Eigen::Index>(i);
    return std::array{places[i].x(), places[i].y(), data.reading[row], data.variance[row]};
  });
  OutlineReadings readings;
  std::vector<double> when;
  std::vector<std::vector<int>> before;
  std::vector<SurfacePoint> in_order;
  std::vector<std::vector<Made>> made;
  std::vector<double> shares;  // of the contrast
  for (const std::size_t i : order) {
    in_order.push_back(data.places[i]);
    made.push_back(data.made[i]);
    const auto row = static_cast<Eigen::Index>(i);
    readings.places.push_back(places[i]);
    shares.push_back(share_at_depth(edge.profile(), data.depth_m[row]));
    readings.reading.push_back(data.reading[row]);
    readings.variance.push_back(data.variance[row]);
    double batches = 0.0;
    for (const Made& one : data.made[i]) batches += one.batch;
    when.push_back(batches / static_cast<double>(data.made[i].size()));
    before.push_back(changes_before(changes, data.made[i]));
    readings.bounds.push_back(bound_of(data.made[i]));
  }
  readings.background = background_terms({.places = readings.places,
                                          .when = when,
                                          .seen = seen_terms(layout, seen, in_order, made),
                                          .steps = steps_of(changes, before)});
  readings.shares = Eigen::Map<const Eigen::VectorXd>(shares.data(), std::ssize(shares));
  readings.epoch = epochs_of(before, prior.epochs);
  if (std::ranges::count(changes, MisfitKind::Late, &Misfit::kind) > 0)
    readings.travel = travel_in_plane(surface, in_order, made);
  readings.where = std::move(in_order);
  readings.made = std::move(made);
  if (std::ranges::count(readings.bounds, Bound::None) == std::ssize(readings.bounds))
    readings.bounds.clear();
  set_heights(readings.background, changes, range);
  return readings;
}

/// What would take each move back again, where the tumour is deepest; a lag wherever it is. Of
/// another change, nothing.
std::vector<Vec2> unmoved(const Surface& surface, const EdgeBelief& edge,
                          std::span<const Misfit> changes) {
  Eigen::Index middle = 0;
  edge.depth().maxCoeff(&middle);
  const Vec3 place = surface.vertex(static_cast<int>(middle));
  std::vector<Vec2> all;
  for (const Misfit& change : changes) {
    all.push_back(change.kind == MisfitKind::Late
                      ? Vec2(-change.amount, 0.0)
                      : chart_place(surface, surface.project(place + change.moved_m)) -
                            chart_place(surface, surface.project(place)));
  }
  return all;
}

/// How far a line may lie from where it was found, over how large that is: the readings beside it,
/// of which half are as near, contradict no more.
double size_log_sd(const std::vector<Vec2>& line, double radius_m,
                   const std::vector<Vec2>& readings) {
  std::vector<double> gaps;
  for (const Vec2& node : line) {
    double square = std::numeric_limits<double>::infinity();
    for (const Vec2& reading : readings) square = std::min(square, (reading - node).squaredNorm());
    gaps.push_back(std::sqrt(square));
  }
  const auto middle = gaps.begin() + std::ssize(gaps) / 2;
  std::ranges::nth_element(gaps, middle);
  return std::clamp(*middle / radius_m, kLeastSizeLogSd, kMostSizeLogSd);
}

/// Where a sensor's range ended, as much again as was felt may lie beyond.
PlateauPrior plateau_prior(const OutlineReadings& readings, double sd, double felt) {
  const auto sd_where_ends = [&](Bound end) {
    return std::ranges::count(readings.bounds, end) > 0 ? std::max(sd, felt) : sd;
  };
  return {sd_where_ends(Bound::AtMost), sd_where_ends(Bound::AtLeast)};
}

}  // namespace

void begin_with(const OutlineNodes& outline, OutlineStart& start) {
  start.outline = outline;
  start.prior.median.log_spacing.assign(outline.loops.size(), std::log(kSpacing_m));
  start.profile.log_spacing = start.prior.median.log_spacing;
  start.prior.median.log_contrast.assign(static_cast<std::size_t>(outline.parts()), 0.0);
  start.profile.log_contrast = start.prior.median.log_contrast;
  const std::vector<Vec2> largest = line_of(outline, outline.loops.front());
  start.prior.middle = Vec2::Zero();
  for (const Vec2& node : largest) start.prior.middle += node / static_cast<double>(largest.size());
  start.prior.radius_m = std::sqrt(std::abs(enclosed_area(largest)) / std::numbers::pi);
  start.prior.size_log_sd = size_log_sd(largest, start.prior.radius_m, start.readings.places);
}

bool moves_zero(const Misfit& change) {
  return change.kind == MisfitKind::Zero ||
         (change.kind == MisfitKind::Gain && change.session == 0);
}

std::optional<OutlineStart> outline_start(const Belief& belief, const Field& mean,
                                          const EdgeBelief& edge, const OutlineOptions& options,
                                          double profile_error) {
  const Surface& surface = belief.prior().surface();
  const EdgeProfile& profile = edge.profile();
  const double range = profile.high - profile.low;
  const std::vector<Misfit>& changes = options.changes;
  const std::vector<std::vector<Vec2>> lines = lines_of(surface, edge.depth());
  if (lines.empty() || !(range > 0.0)) return std::nullopt;
  OutlineStart start;
  start.readings = readings_in_plane(belief, edge, range, options,
                                     std::pow(profile_error * range, 2), start.prior);
  const OutlineNodes outline = outline_from(lines, start.readings.places);
  if (outline.loops.empty()) return std::nullopt;
  const ShapePrior shape;
  OutlineProfile& median = start.prior.median;
  median = {.low = mean.minCoeff(),
            .high = mean.maxCoeff(),
            .log_slope = std::log(shape.slope_per_m),
            .turns = {.log_half_width = std::log(kTurn)},
            .log_spacing = {},
            .log_contrast = {},
            .moved_m = unmoved(surface, edge, changes),
            .log_gain = std::vector(changes.size(), 0.0)};
  for (const Misfit& change : changes) {
    start.prior.changes.push_back(change.kind);
    start.prior.gain_log_sd.push_back(change.session > 0 ? kSessionGainLogSd : kGainLogSd);
  }
  const double felt = median.high - median.low, sd = plateau_sd(belief, felt);
  start.prior.plateaus = plateau_prior(start.readings, sd, felt);
  start.prior.slope = {shape.slope_log_sd, edge.depth().maxCoeff()};
  start.prior.residuals.wild_density = 1.0 / (2.0 * kWildRanges * sd);
  start.prior.residuals.noise_log_sd =
      options.noise_log_sd > 0.0 ? kLearnedNoiseLogSd : kGivenNoiseLogSd;
  start.prior.fraction = options.fraction;
  start.profile = median;
  start.profile.lean = Lean::Zero();  // a sharp one is found sooner by steps than by a switch
  start.profile.moved_m.assign(changes.size(), Vec2::Zero());
  start.profile.low = profile.low;
  start.profile.high = profile.high;
  start.profile.log_slope = std::log(profile.slope_per_m);
  begin_with(outline, start);
  return start;
}

}  // namespace palpation
