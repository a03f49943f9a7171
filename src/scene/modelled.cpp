#include "scene/modelled.h"

#include <algorithm>
#include <set>

#include "palpation/certainty/misfit.h"

namespace palpation::tool {
namespace {

using Terms = std::vector<std::string>;

std::string level_term(const Conclusion& conclusion) {
  if (!conclusion.level) return conclusion.evidence.of_edge ? "no edge" : "no tumour";
  if (conclusion.model.level.known) return "known level";
  return conclusion.edge ? "level at the edge" : "level from the range";
}

/// Of tissue, sensor and probe, for the whole field.
void add_terms_of_field(const Conclusion& conclusion, Terms& terms) {
  const Model& model = conclusion.model;
  if (conclusion.scale() == ReadingScale::Log) terms.emplace_back("logarithms");
  if (conclusion.belief.prior().has_slope()) terms.emplace_back("slope");
  if (model.field.probe.screening) terms.emplace_back("screening");
  if (conclusion.lag) terms.emplace_back("lag");
  if (model.field.probe.indenter_radius_m > 0.0) terms.emplace_back("tip");
  if (model.contrast.least) terms.emplace_back("least contrast");
  if (model.band && model.band->place_sd_m > 0.0) terms.emplace_back("registration");
}

std::string term_of(const Misfit& change) {
  if (change.session > 0) return "sessions";
  if (change.kind == MisfitKind::Moved) return "tissue that moved";
  if (change.kind == MisfitKind::Tilted) return "a slope that was found";
  if (change.kind == MisfitKind::Waves) return "slow waves that were found";
  if (change.kind == MisfitKind::Drift) return "drift that was found";
  if (change.kind == MisfitKind::Late) return "lag that was found";
  return std::string(name_of(change.kind)) + " that changed";
}

bool has_own_contrast(const PartContrast& part) { return part.stddev > 0.0; }

}  // namespace

std::vector<std::string> modelled(const Conclusion& conclusion) {
  Terms terms = {level_term(conclusion)};
  add_terms_of_field(conclusion, terms);
  std::set<std::string> changes;
  for (const Misfit& change : conclusion.evidence.taken_back) changes.insert(term_of(change));
  terms.insert(terms.end(), changes.begin(), changes.end());
  if (conclusion.edge && std::ranges::any_of(conclusion.edge->parts(), has_own_contrast))
    terms.emplace_back("unequal parts");
  if (conclusion.outlines) {
    for (const char* term : {"outlines with corners", "bent edges", "leaning edges", "waves",
                             "drift", "tilt", "wild readings"})
      terms.emplace_back(term);
    if (conclusion.outlines->misfit.wandering) terms.emplace_back("places that wander");
  }
  if (!conclusion.certainty) return terms;
  terms.emplace_back(conclusion.outlines ? "sampled certainty"
                     : conclusion.edge   ? "Laplace's certainty"
                                         : "the field's certainty");
  return terms;
}

}  // namespace palpation::tool
