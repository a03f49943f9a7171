#include "exploration/background_search.h"

#include <utility>

#include "certainty/edge_data.h"

namespace palpation {

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
                         const std::vector<Palpation>& felt, Known flat, const KnownOf& known_of) {
  if (!model.level.is_of_edge() || model.field.trend.is_linear || model.field.is_noiseless() ||
      flat.believed.belief.site_count() == 0)
    return flat;
  std::optional<WithoutBackground> tilted = without_tilt(surface, felt, flat, known_of);
  const bool is_tilted = tilted && tilted->gain > surprising();
  Known& simpler = is_tilted ? tilted->known : flat;
  std::optional<WithoutBackground> waved = without_waves(surface, felt, flat, simpler, known_of);
  return waved && waved->gain > surprising() ? std::move(waved->known) : std::move(simpler);
}

}  // namespace palpation
