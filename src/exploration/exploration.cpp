#include "palpation/exploration/exploration.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "boundary/erosion.h"
#include "certainty/contrast.h"
#include "exploration/field_fit.h"
#include "exploration/screened_readings.h"
#include "palpation/base/error.h"
#include "palpation/certainty/edge_profile.h"
#include "palpation/certainty/level_estimate.h"
#include "palpation/decision/tour.h"
#include "palpation/geometry/distance.h"
#include "readings/contact.h"
#include "readings/readings.h"

namespace palpation {
namespace {

/// While no contrast is seen: the part of a batch that looks again where readings were high, and
/// how noisy they are taken to be then, as a part of their standard deviation. Half of the variance
/// noise is what tells a tumour's few readings from a fluke least hastily.
constexpr double kSecondLooks = 0.3;
constexpr double kDoubt = 0.7;
/// Less than any two vertices of tissue are apart: keeps a batch from touching one of them twice.
constexpr double kDistinct_m = 1e-12;
constexpr double kRounding = 1e-13;

/// Whether the mean has a range: that of rounding is none, and to cut it would make tumours of
/// noise.
bool has_range(const Marginals& marginals) {
  const double least = marginals.mean.minCoeff(), greatest = marginals.mean.maxCoeff();
  const double scale =
      std::max({std::abs(least), std::abs(greatest), std::sqrt(marginals.variance.maxCoeff())});
  return greatest - least > kRounding * scale;
}

}  // namespace

Exploration::Exploration(Surface surface, Model model, Plan plan, Reach reach)
    : surface_(std::move(surface)),
      model_(std::move(model)),
      plan_(std::move(plan)),
      reachable_(static_cast<std::size_t>(surface_.vertex_count()), reach.vertices.empty()),
      touch_once_(reach.touch_once || model_.field.is_noiseless()),
      belief_(unlearned(surface_, model_.field)),
      marginals_(belief_.at_vertices()),
      component_(marginals_) {
  check(model_);
  check(plan_);
  for (int vertex : reach.vertices) {
    require(vertex >= 0 && vertex < surface_.vertex_count(), "Reach",
            "vertex " + std::to_string(vertex), "is not on the surface");
    reachable_[vertex] = true;
  }
  if (model_.level.known) level_ = Level{*model_.level.known, 0.0};
  if (touch_once_ && plan_.batch.least_spacing_m == 0.0) plan_.batch.least_spacing_m = kDistinct_m;
  contrast_seen_ = !model_.needs_contrast();
  plan_next();
}

std::vector<int> Exploration::next() const { return next_; }

void Exploration::record(std::span<const Palpation> palpations) {
  std::vector<bool> answered(static_cast<std::size_t>(surface_.vertex_count()), false);
  for (const Palpation& palpation : palpations) {
    if (const int vertex = surface_.vertex_at(palpation.where); vertex >= 0)
      answered[vertex] = true;
  }
  for (int stop : next_) {
    if (!answered[stop]) reachable_[stop] = false;
  }
  learn_from(palpations);
}

void Exploration::foresee() {
  const bool is_built_anew =
      restates_known_readings(model_.field) || (model_.field.learns() && !may_grow(model_.field));
  if (next_.empty() || is_built_anew) return;
  std::vector<SurfacePoint> places;
  for (const int stop : next_) places.push_back(surface_.at_vertex(stop));
  belief_ = belief_.foresee(places);
}

void Exploration::take_up(std::span<const Palpation> palpations) { learn_from(palpations); }

void Exploration::learn_from(std::span<const Palpation> palpations) {
  ++batch_;
  for (const Palpation& palpation : palpations) {
    batch_ = std::max(batch_, palpation.batch + 1);
    const int vertex = surface_.vertex_at(palpation.where);
    if (touch_once_ && vertex >= 0) reachable_[vertex] = false;
  }
  std::vector<Palpation> recorded = recorded_;
  recorded.insert(recorded.end(), palpations.begin(), palpations.end());
  std::vector<Palpation> all = screened_readings(surface_, model_.field, recorded, lag_);
  const double evidence = believe(all, palpations);
  if (!trend_is_missing()) judge_contrast(all, evidence);
  recorded_ = std::move(recorded);
  palpations_ = std::move(all);
  marginals_ = belief_.at_vertices();
  component_ = marginals_;
  if (model_.field.trend.is_linear) component_.mean = belief_.at_vertices(Part::Detrended).mean;
  edge_.reset();
  if (!model_.level.known) level_.reset();
  if (belief_.site_count() > 0 && contrast_seen_ && !trend_is_missing() && !model_.level.known) {
    const bool is_flat = all_equal(used_readings(palpations_)) || !has_range(component_);
    if (!is_flat) estimate_boundary();
  }
  certainty_.reset();
  untouched_m2_ = 0.0;
  if (level_ && belief_.site_count() > 0) {
    certainty_ =
        edge_ ? certainty_of(surface_, *edge_, model_.band_probability)
              : certainty_of(surface_, belief_, component_, *level_, model_.band_probability);
    if (model_.field.probe.screening) doubt_where_contact_fades();
    if (model_.field.probe.indenter_radius_m > 0.0)
      take_back_tip(*certainty_, surface_, model_.field.probe.indenter_radius_m);
    if (edge_) untouched_m2_ = doubt_untouched(*certainty_, belief_, component_, *level_);
    expected_errors_m2_.push_back(certainty_->expected.symmetric_difference_m2());
  }
  if (model_.field.probe.indenter_radius_m > 0.0 && level_)
    component_.mean = eroded(surface_, component_.mean, model_.field.probe.indenter_radius_m).field;
  if (!palpations.empty()) probe_ = palpations.back().where;
  plan_next();
}

void Exploration::estimate_boundary() {
  if (model_.level.estimate == LevelEstimate::Range) {
    level_ = level_from_range(component_, model_.level.fraction);
    return;
  }
  level_ = level_from_edge(surface_, belief_, component_, model_.level.fraction);
  // The profile may have settled on noise: the middle of the readings' own two plateaus is a second
  // start.
  std::vector<double> first_levels = {level_->value};
  if (const auto plateaus = two_plateaus(used_readings(belief_.detrended_palpations()))) {
    first_levels.push_back(plateaus->low +
                           model_.level.fraction * (plateaus->high - plateaus->low));
  }
  const double noise_log_sd =
      model_.field.noise.sd.is_learned() ? learned_noise_log_sd(belief_.site_count()) : 0.0;
  edge_ = EdgeBelief::around(belief_, component_, first_levels, model_.level.fraction, {},
                             noise_log_sd);
  if (edge_) level_ = edge_->level();
  // Where contact fades no profile fits: its plateau may run away, and with it the level. The
  // mean's range is left: its least is felt all over healthy tissue, its greatest is as unsure a
  // plateau as it was for the profile.
  const double least = component_.mean.minCoeff(), greatest = component_.mean.maxCoeff(),
               fraction = model_.level.fraction;
  if (level_->value > least && level_->value < greatest) return;
  edge_.reset();
  level_ = level_from_range(component_, fraction);
  level_->stddev = fraction * ShapePrior{}.plateau_error * (greatest - least);
}

/// A sigmoid's steepest rise is a quarter of slope times contrast.
void Exploration::doubt_where_contact_fades() {
  const std::optional<FadingContact> fading = fading_contact(surface_, palpations_);
  if (!fading) return;
  if (edge_) {
    doubt_fading_contact(*certainty_, surface_, *fading, edge_->offset_sd(),
                         4.0 * model_.level.fraction / edge_->profile().slope_per_m);
    return;
  }
  const double level_sd = level_->stddev.value_or(0.0),
               contrast = component_.mean.maxCoeff() - component_.mean.minCoeff();
  const Field sd = (component_.variance.array() + level_sd * level_sd).sqrt();
  doubt_fading_contact(*certainty_, surface_, *fading, sd, model_.level.fraction * contrast);
}

bool Exploration::tip_hides_all() const {
  if (model_.field.probe.indenter_radius_m == 0.0 || !edge_ || edge_->depth().maxCoeff() < 0.0)
    return false;
  return contour().field.maxCoeff() < 0.0;
}

Contour Exploration::contour() const {
  require(level_.has_value(), "Exploration::contour", "no level", "draws no boundary");
  if (edge_)
    return {eroded(surface_, edge_->depth(), model_.field.probe.indenter_radius_m).field, 0.0};
  return {component_.mean, level_->value};
}

bool Exploration::trend_is_missing() const {
  return model_.field.trend.is_linear && !belief_.prior().has_slope();
}

/// Until contrast is seen, a learned field is not to be believed: spread the touches by the
/// variance of a field of the prior's length instead.
Acquisition Exploration::acquisition_in_force() const {
  return contrast_seen_ && level_ && !trend_is_missing() ? plan_.acquisition : Acquisition(evr());
}

/// What will be felt at these stops, and on the way to them, if all is as it is believed to be.
std::vector<Palpation> Exploration::suppositions(const Belief& belief, std::span<const int> stops,
                                                 const BatchOptions& options) const {
  std::vector<Palpation> supposed;
  std::vector<Vec3> places;
  if (options.from) places.push_back(surface_.position(*options.from));
  for (int stop : stops) {
    for (const Supposed& reading :
         supposed_on_the_way(belief, places, stop, options.way_reading_m)) {
      supposed.push_back({.where = surface_.at_vertex(reading.vertex),
                          .reading = marginals_.mean[reading.vertex],
                          .noise_variance = reading.noise_variance});
    }
    supposed.push_back({.where = surface_.at_vertex(stop), .reading = marginals_.mean[stop]});
    places.push_back(surface_.vertex(stop));
  }
  return supposed;
}

std::vector<int> Exploration::candidates() const {
  std::vector<int> vertices;
  for (int vertex = 0; vertex < surface_.vertex_count(); ++vertex) {
    if (reachable_[vertex]) vertices.push_back(vertex);
  }
  return vertices;
}

Field Exploration::acquisition_field() const {
  return score(acquisition_in_force(), belief_, level_.value_or(Level{}));
}

std::vector<int> Exploration::in_tour_order(std::vector<int> stops) const {
  if (stops.empty()) return stops;
  std::vector<SurfacePoint> places = {
      probe_ ? *probe_ : surface_.at_vertex(*std::min_element(stops.begin(), stops.end()))};
  for (const int stop : stops) places.push_back(surface_.at_vertex(stop));
  Eigen::MatrixXd distance = distances_between(surface_, places);
  // Between components the probe flies: those ways come last.
  const double farthest = surface_.diameter() * static_cast<double>(surface_.face_count());
  distance = distance.cwiseMin(farthest);
  std::vector<int> ordered;
  for (int stop : shortest_tour(distance)) ordered.push_back(stops[stop]);
  return ordered;
}

void Exploration::plan_next() {
  next_.clear();
  stop_reason_.clear();
  if (batch_ == 0 && plan_.initial.count > 0) {
    Random random(plan_.initial.seed);
    next_ = in_tour_order(
        initial_design(surface_, plan_.initial.design, plan_.initial.count, candidates(), random));
    if (next_.empty()) stop_reason_ = "nothing left to touch";
    return;
  }
  const int done = plan_.initial.count > 0 ? batch_ - 1 : batch_;
  if (done >= plan_.batches) {
    stop_reason_ = "budget";
    return;
  }
  stop_reason_ = reason_to_stop();
  if (!stop_reason_.empty()) return;
  next_ = in_tour_order(chosen_stops());
  if (next_.empty()) stop_reason_ = "nothing left to touch";
  if (contrast_seen_ && certainty_ &&
      gains_too_little(plan_.stop, expected_errors_m2_, *certainty_, surface_, belief_, *level_,
                       next_)) {
    next_.clear();
    stop_reason_ = "nothing to gain";
  }
}

/// No contrast is seen yet: spread over the tissue, and a second look where readings were high.
std::vector<int> Exploration::searching_stops() const {
  BatchOptions options = plan_.batch;
  options.from = probe_;
  const std::vector<double> readings = used_readings(belief_.palpations());
  std::vector<int> stops;
  if (model_.safe_start && model_.field.learns() && readings.size() > 1 && !all_equal(readings)) {
    Kernel kernel = kernel_of(model_.field.kernel);
    kernel.signal_sd = spread_of(readings).sd;
    const Belief doubting(unlearned(surface_, model_.field).prior().with(kernel),
                          {.noise_sd = kDoubt * kernel.signal_sd});
    options.size = static_cast<int>(std::floor(kSecondLooks * plan_.batch.size));
    stops = choose_batch(doubting.condition_on(belief_.palpations()), ucb(0.5), Level{},
                         candidates(), options)
                .vertices;
    options.size = plan_.batch.size;
  }
  return with_others(std::move(stops),
                     unlearned(surface_, model_.field).condition_on(belief_.palpations()), options);
}

/// First what tells the most about the boundary, then what the acquisition finds best once those
/// are touched.
std::vector<int> Exploration::chosen_stops() const {
  BatchOptions options = plan_.batch;
  options.from = probe_;
  if (!contrast_seen_) return searching_stops();
  std::vector<int> stops;
  if (edge_) {
    // Search first, then refine: from half the share to half as much again over the plan's batches.
    const double progress = static_cast<double>(batch_) / std::max(plan_.batches, 1);
    const int count = static_cast<int>(
        std::lround(std::min(plan_.edge_share * (0.5 + progress), 1.0) * options.size));
    stops = edge_->most_telling(candidates(), count, options.least_spacing_m, marginals_.variance);
  }
  return with_others(std::move(stops), edge_ ? searching_belief() : belief_, options);
}

/// The field of one large tumour is smooth; a second, small one would hide between touches that are
/// spread by its length. Look for it with the length that was likely beforehand, where that is
/// shorter.
Belief Exploration::searching_belief() const {
  Kernel kernel = belief_.prior().kernel();
  if (!model_.field.kernel.length_m.is_learned() ||
      kernel.length_m <= model_.field.kernel.length_median_m)
    return belief_;
  kernel.length_m = model_.field.kernel.length_median_m;
  return Belief(belief_.prior().with(kernel), belief_.options()).condition_on(belief_.palpations());
}

/// These stops, and as many others as the batch still takes by the acquisition, of a belief that
/// supposes the stops touched.
std::vector<int> Exploration::with_others(std::vector<int> stops, Belief believed,
                                          BatchOptions options) const {
  if (!stops.empty()) {
    believed = believed.condition_on(suppositions(believed, stops, options));
    options.size -= static_cast<int>(stops.size());
  }
  std::vector<int> others = candidates();
  std::vector<int> taken = stops;
  for (const int stop : stops) {
    const std::vector<int> near = vertices_near(surface_, stop, options.least_spacing_m);
    taken.insert(taken.end(), near.begin(), near.end());
  }
  std::sort(taken.begin(), taken.end());
  std::erase_if(others,
                [&](int vertex) { return std::binary_search(taken.begin(), taken.end(), vertex); });
  const std::vector<int> rest =
      choose_batch(believed, acquisition_in_force(), level_.value_or(Level{}), others, options)
          .vertices;
  stops.insert(stops.end(), rest.begin(), rest.end());
  return stops;
}

/// By how sure the boundary is; the rest of the reasons show when the next batch is planned.
std::string Exploration::reason_to_stop() const {
  // Without a boundary nothing is known of how wrong it is: a level that no reading crosses is no
  // reason to stop.
  if (!contrast_seen_ || !certainty_ || certainty_->half_width_m == 0.0) return "";
  if (certainty_->expected.symmetric_difference_m2() <= plan_.stop.error_m2 &&
      plan_.stop.error_m2 > 0.0)
    return "expected error";
  if (certainty_->half_width_m <= plan_.stop.band_m) return "band";
  return "";
}

}  // namespace palpation
