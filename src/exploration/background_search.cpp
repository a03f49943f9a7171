#include "exploration/background_search.h"

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

Known without_background(const Surface& surface, const Model& model,
                         const std::vector<Palpation>& felt, Known flat, const KnownOf& known_of,
                         bool is_last) {
  if (!model.level.is_of_edge() || model.field.trend.is_linear || model.field.is_noiseless() ||
      flat.believed.belief.site_count() == 0)
    return flat;
  std::optional<WithoutBackground> without = without_tilt(surface, felt, flat, known_of);
  if (is_last) {
    std::optional<WithoutBackground> stepped =
        without_zero_step(surface, model, felt, flat, known_of);
    if (stepped && !(without && without->gain > stepped->gain)) without = std::move(stepped);
  }
  Known& simpler = without && without->gain > surprising() ? without->known : flat;
  std::optional<WithoutBackground> waved = without_waves(surface, felt, flat, simpler, known_of);
  return waved && waved->gain > surprising() ? std::move(waved->known) : std::move(simpler);
}

}  // namespace palpation
