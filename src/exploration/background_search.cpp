#include "exploration/background_search.h"

#include <algorithm>
#include <utility>

#include "certainty/edge_data.h"
#include "exploration/change_search.h"
#include "exploration/taken_back.h"

namespace palpation {
namespace {

/// Of a raster, which takes it for a step of the tissue, or for waves.
std::optional<WithoutBackground> without_zero_step(const Surface& surface, const Model& model,
                                                   const std::vector<Palpation>& felt,
                                                   const Known& flat, const KnownOf& known_of) {
  const std::optional<RasterStep> step = raster_step(
      model, flat, with_changes_taken_back(surface, felt, flat.believed.evidence.taken_back));
  if (!step || !step->is_of_the_zero()) return std::nullopt;
  Known known = known_of(with_changes_taken_back(surface, felt, {&step->zero, 1}));
  std::vector<Misfit>& changes = known.believed.evidence.taken_back;
  changes.insert(changes.begin(), step->zero);
  return WithoutBackground{std::move(known), step->gain};
}

}  // namespace

bool is_step_of_zero(const Misfit& change) {
  return change.kind == MisfitKind::Zero && change.session == 0;
}

std::ptrdiff_t steps_of_zero(const Known& known) {
  return std::ranges::count_if(known.believed.evidence.taken_back, is_step_of_zero);
}

std::ptrdiff_t set_aside(const Known& known) {
  return std::ranges::count_if(known.believed.palpations,
                               [](const Palpation& one) { return !counts(one); });
}

double log_evidence_of(const Known& known) {
  const std::optional<EdgeBelief>& edge = known.boundary.edge;
  return edge ? edge->log_evidence() : log_evidence_without_edge(known.believed.belief);
}

double log_evidence_or_drop(Known& known) {
  const double without_edge = log_evidence_without_edge(known.believed.belief),
               with_edge = log_evidence_of(known);
  if (with_edge > without_edge + surprising()) return with_edge;
  known.boundary.edge.reset();
  known.boundary.level.reset();
  known.believed.evidence.contrast_seen = false;
  return without_edge;
}

namespace {

bool may_have_background(const Model& model, const Known& flat) {
  return model.level.is_of_edge() && !model.field.trend.is_linear && !model.field.is_noiseless() &&
         flat.believed.belief.site_count() > 0;
}

/// The one that gains the most by more than chance does; `flat` where none does.
const Known& simplest(const Known& flat, const std::optional<WithoutBackground>& one,
                      const std::optional<WithoutBackground>& other) {
  const auto gain = [](const std::optional<WithoutBackground>& without) {
    return without ? without->gain : 0.0;
  };
  const std::optional<WithoutBackground>& most = gain(other) > gain(one) ? other : one;
  return gain(most) > surprising() ? most->known : flat;
}

}  // namespace

TriedBackgrounds tried_backgrounds(const Surface& surface, const Model& model,
                                   const std::vector<Palpation>& felt, Known flat,
                                   const KnownOf& known_of) {
  TriedBackgrounds tried{model, felt, std::move(flat), {}, {}};
  if (!may_have_background(model, tried.flat)) return tried;
  tried.tilted = without_tilt(surface, felt, tried.flat, known_of);
  if (tried.tilted && !(tried.tilted->gain > surprising())) tried.tilted.reset();
  tried.waved = without_waves(surface, felt, tried.flat, known_of);
  return tried;
}

Known without_background(const Surface& surface, const TriedBackgrounds& tried,
                         const KnownOf& known_of, bool is_last) {
  const Known& flat = tried.flat;
  if (!may_have_background(tried.model, flat)) return flat;
  const double noise = flat.believed.belief.noise_variance();
  std::optional<WithoutBackground> stepped;
  std::optional<BesideEdge> drifted;
  if (is_last) {
    stepped = without_zero_step(surface, tried.model, tried.felt, flat, known_of);
    drifted = without_drift(surface, tried.felt, flat, known_of);
  }
  const Known& simpler = simplest(flat, tried.tilted, stepped);
  const double waves_gain =
      tried.waved ? tried.waved->log_evidence - log_evidence_in_waves(surface, simpler, noise)
                  : 0.0;
  const double drift_gain =
      drifted
          ? drifted->log_evidence - log_evidence_in_errors(simpler, std::ssize(tried.felt), noise)
          : 0.0;
  if (!(std::max(waves_gain, drift_gain) > surprising())) return simpler;
  return waves_gain > drift_gain ? tried.waved->known : drifted->known;
}

}  // namespace palpation
