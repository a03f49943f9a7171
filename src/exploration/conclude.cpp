#include <algorithm>
#include <utility>

#include "boundary/erosion.h"
#include "exploration/believe.h"
#include "exploration/find_boundary.h"
#include "palpation/exploration/conclusion.h"
#include "palpation/readings/screening.h"

namespace palpation {
namespace {

/// Whether a reading was set aside for a reason that this model judges anew.
bool is_judged_anew(const Palpation& palpation, const Model& model) {
  const std::string& reason = palpation.set_aside;
  if (reason == kNoContact || reason == kOutlier) return true;
  if (reason == kStandsAlone) return model.needs_contrast();
  const auto of_rows = {kJammed, kFrozen, kStartUp, kBaseStep};
  return model.field.probe.screening && std::ranges::find(of_rows, reason) != of_rows.end();
}

/// Those that were made, as they were made.
std::vector<Palpation> felt_among(std::span<const Palpation> readings, const Model& model) {
  std::vector<Palpation> felt;
  for (const Palpation& reading : readings) {
    if (reading.kind == TouchKind::Missed) continue;
    felt.push_back(reading);
    if (is_judged_anew(reading, model)) felt.back().set_aside.clear();
  }
  return felt;
}

/// What level and boundary are of.
Marginals component_of(const Believed& believed, const Model& model, const Marginals& marginals) {
  Marginals component = marginals;
  if (model.field.trend.is_linear)
    component.mean = believed.belief.at_vertices(Part::Detrended).mean;
  return component;
}

}  // namespace

Conclusion conclude(const Surface& surface, const Model& model, std::span<const Palpation> readings,
                    ConclusionCache* cache) {
  check(model);
  ConclusionCache own;
  // Equations (1) and (2), and whether they show more than noise.
  Believed believed =
      believe(surface, model, felt_among(readings, model), cache != nullptr ? *cache : own);
  Marginals marginals = believed.belief.at_vertices();
  Marginals component = component_of(believed, model, marginals);
  // The level (section V.3, equation 4) and its level set.
  BoundaryFit boundary = find_boundary(surface, model, believed, component);
  std::optional<Certainty> certainty;
  if (boundary.level && believed.belief.site_count() > 0)
    certainty = certainty_of(surface, model, believed, component, boundary);

  const double tip_m = model.field.probe.indenter_radius_m;
  std::optional<Contour> contour;
  bool tip_hides_all = false;
  if (boundary.level) {
    if (tip_m > 0.0 && !readings.empty())
      component.mean = eroded(surface, component.mean, tip_m).field;
    contour = boundary.edge ? Contour{eroded(surface, boundary.edge->depth(), tip_m).field, 0.0}
                            : Contour{component.mean, boundary.level->value};
    tip_hides_all = tip_m > 0.0 && boundary.edge && boundary.edge->depth().maxCoeff() >= 0.0 &&
                    contour->field.maxCoeff() < 0.0;
  }
  return {model,
          std::move(believed.palpations),
          std::move(believed.belief),
          std::move(marginals),
          std::move(component),
          std::move(believed.evidence),
          believed.lag,
          boundary.level,
          std::move(boundary.edge),
          std::move(contour),
          tip_hides_all,
          std::move(certainty)};
}

}  // namespace palpation
