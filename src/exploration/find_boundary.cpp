#include "exploration/find_boundary.h"

#include <algorithm>
#include <cmath>

#include "certainty/contrast.h"
#include "certainty/doubts.h"
#include "certainty/edge_data.h"
#include "palpation/certainty/edge_profile.h"
#include "palpation/certainty/level_estimate.h"
#include "readings/readings.h"

namespace palpation {
namespace {

constexpr double kRounding = 1e-13;

/// Whether the mean has a range: that of rounding is none, and to cut it would make tumours of
/// noise.
bool has_range(const Marginals& marginals) {
  const double least = marginals.mean.minCoeff(), greatest = marginals.mean.maxCoeff();
  const double scale =
      std::max({std::abs(least), std::abs(greatest), std::sqrt(marginals.variance.maxCoeff())});
  return greatest - least > kRounding * scale;
}

double noise_log_sd_of(const Model& model, const Belief& belief) {
  return model.field.noise.sd.is_learned() ? learned_noise_log_sd(belief.site_count()) : 0.0;
}

/// The profile of the readings across the edge (equation 4), and what it tells of the boundary.
BoundaryFit from_edge(const Surface& surface, const Model& model, const Belief& belief,
                      const Marginals& component) {
  const double fraction = model.level.fraction;
  BoundaryFit fit{.level = level_from_edge(surface, belief, component, fraction)};
  // The profile may have settled on noise: the middle of the readings' own two plateaus is a second
  // start.
  std::vector<double> first_levels = {fit.level->value};
  if (const auto plateaus = two_plateaus(used_readings(belief.detrended_palpations())))
    first_levels.push_back(plateaus->low + fraction * (plateaus->high - plateaus->low));
  fit.edge = edge_around(model, belief, component, first_levels);
  if (fit.edge) fit.level = fit.edge->level();
  // Where contact fades no profile fits: its plateau may run away, and with it the level, until it
  // is out of the mean's range or nothing is inside. That range is left: its least is felt all over
  // healthy tissue, its greatest is as unsure a plateau as it was for the profile.
  const double least = component.mean.minCoeff(), greatest = component.mean.maxCoeff();
  const bool is_felt = fit.level->value > least && fit.level->value < greatest,
             is_empty = fit.edge && fit.edge->depth().maxCoeff() < 0.0;
  if (is_felt && !is_empty) return fit;
  fit = {.level = level_from_range(component, fraction)};
  fit.level->stddev = fraction * plateau_sd(belief, greatest - least);
  return fit;
}

/// A sigmoid's steepest rise is a quarter of slope times contrast.
Certainty with_fading_contact(Certainty certainty, const Surface& surface, const Model& model,
                              const Believed& believed, const Marginals& component,
                              const BoundaryFit& boundary) {
  const std::optional<FadingContact> fading = fading_contact(surface, believed.palpations);
  if (!fading) return certainty;
  const double fraction = model.level.fraction;
  if (boundary.edge) {
    return doubted_where_contact_fades(std::move(certainty), surface, *fading,
                                       *boundary.offset_sd(),
                                       4.0 * fraction / boundary.edge->profile().slope_per_m);
  }
  const double level_sd = boundary.level->stddev.value_or(0.0),
               contrast = component.mean.maxCoeff() - component.mean.minCoeff();
  const Field sd = (component.variance.array() + level_sd * level_sd).sqrt();
  return doubted_where_contact_fades(std::move(certainty), surface, *fading, sd,
                                     fraction * contrast);
}

/// In metres, where no boundary has a belief of its own: from the band that the field gave; zero
/// where there is no band.
Field mean_offset_sd(const Surface& surface, const Certainty& certainty) {
  return Field::Constant(surface.vertex_count(), certainty.half_width_m / certainty.band_score);
}

Certainty known_before_faults(const Surface& surface, const Model& model,
                              const Marginals& component, const BoundaryFit& boundary) {
  if (boundary.outlines) return certainty_of(surface, *boundary.outlines, model.band->probability);
  if (boundary.edge) return certainty_of(surface, *boundary.edge, model.band->probability);
  return certainty_of(surface, component, *boundary.level, model.band->probability);
}

}  // namespace

const Field* BoundaryFit::depth() const {
  if (outlines) return &outlines->depth;
  return edge ? &edge->depth() : nullptr;
}

const Field* BoundaryFit::offset_sd() const {
  if (outlines) return &outlines->spread;
  return edge ? &edge->offset_sd() : nullptr;
}

std::optional<EdgeBelief> edge_around(const Model& model, const Belief& belief,
                                      const Marginals& component,
                                      const std::vector<double>& first_levels,
                                      const ShapePrior& shape) {
  return EdgeBelief::around(belief, component, first_levels, model.level.fraction, shape,
                            noise_log_sd_of(model, belief));
}

BoundaryFit find_boundary(const Surface& surface, const Model& model, const Believed& believed,
                          const Marginals& component) {
  if (model.level.known) return {.level = Level{*model.level.known, 0.0}};
  const Belief& belief = believed.belief;
  const bool is_flat = belief.site_count() == 0 || !believed.evidence.allows_boundary() ||
                       all_equal(used_readings(believed.palpations)) || !has_range(component);
  if (is_flat) return {};
  if (model.level.estimate == LevelEstimate::Range)
    return {.level = level_from_range(component, model.level.fraction)};
  return from_edge(surface, model, belief, component);
}

namespace {

/// And those that sessions may be, until readings tell: what a gain differs by is drawn, too. In
/// time.
std::vector<Misfit> with_gains_of_sessions(std::vector<Misfit> changes) {
  // The outlines' background has the rest of a slope or waves.
  std::erase_if(changes, is_background);
  std::vector<Misfit> gains;
  std::vector<int> known;  // sessions of which a gain was taken back
  for (const Misfit& change : changes) {
    if (change.kind == MisfitKind::Gain) known.push_back(change.session);
  }
  for (const Misfit& change : changes) {
    if (change.session == 0 || std::ranges::count(known, change.session) > 0) continue;
    gains.push_back(change);
    gains.back().kind = MisfitKind::Gain;
    gains.back().amount = 0.0;
  }
  changes.insert(changes.end(), gains.begin(), gains.end());
  std::ranges::stable_sort(changes, {},
                           [](const Misfit& one) { return std::pair(one.from_batch, one.number); });
  return changes;
}

std::optional<WaveScale> slow_waves_among(const std::vector<Misfit>& changes) {
  const auto waves = std::ranges::find(changes, MisfitKind::Waves, &Misfit::kind);
  if (waves == changes.end()) return std::nullopt;
  return waves->background.wave_scale;
}

Eigen::VectorXd drift_among(const std::vector<Misfit>& changes) {
  const auto drift = std::ranges::find(changes, MisfitKind::Drift, &Misfit::kind);
  return drift == changes.end() ? Eigen::VectorXd() : drift->background.drift;
}

}  // namespace

OutlineOptions outline_options(const Model& model, const Believed& believed, std::uint64_t seed) {
  return {.fraction = model.level.fraction,
          .noise_log_sd = noise_log_sd_of(model, believed.belief),
          .seed = seed,
          .one_by_one = believed.one_by_one,
          .changes = with_gains_of_sessions(believed.evidence.taken_back),
          .background = {slow_waves_among(believed.evidence.taken_back),
                         believed.evidence.errors_beside_edge,
                         drift_among(believed.evidence.taken_back)}};
}

void draw_outlines(BoundaryFit& boundary, const Model& model, const Believed& believed,
                   std::uint64_t seed) {
  if (!boundary.edge) {
    // What the range of the mean parts may guide a plan. Where contact does not fade, and still no
    // edge fits when all is felt, it is noise.
    const Surface& surface = believed.belief.prior().surface();
    if (model.level.is_of_edge() && !fading_contact(surface, believed.palpations)) boundary = {};
    return;
  }
  boundary.outlines =
      sample_outlines(believed.belief, *boundary.edge, outline_options(model, believed, seed));
  if (boundary.outlines) boundary.level = boundary.outlines->level;
}

Certainty certainty_of(const Surface& surface, const Model& model, const Believed& believed,
                       const Marginals& component, const BoundaryFit& boundary) {
  const ProbeModel& probe = model.field.probe;
  Certainty certainty = known_before_faults(surface, model, component, boundary);
  if (probe.screening)
    certainty =
        with_fading_contact(std::move(certainty), surface, model, believed, component, boundary);
  if (model.band->place_sd_m > 0.0) {
    const Field offset_sd_m =
        boundary.edge ? *boundary.offset_sd() : mean_offset_sd(surface, certainty);
    certainty =
        doubted_as_a_whole(std::move(certainty), surface, offset_sd_m, model.band->place_sd_m);
  }
  if (probe.indenter_radius_m > 0.0)
    certainty = less_tip(std::move(certainty), surface, probe.indenter_radius_m);
  if (boundary.edge)
    certainty =
        doubted_where_untouched(std::move(certainty), believed.belief, component, *boundary.level);
  return certainty;
}

}  // namespace palpation
