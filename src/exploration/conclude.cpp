#include <algorithm>
#include <utility>

#include "boundary/erosion.h"
#include "exploration/believe.h"
#include "exploration/find_boundary.h"
#include "exploration/weak_parts.h"
#include "exploration/zero_changes.h"
#include "palpation/base/error.h"
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

/// The readings as they were made, with the reasons why some are set aside.
std::vector<Palpation> as_made(std::vector<Palpation> felt, std::span<const Palpation> believed) {
  for (std::size_t i = 0; i < felt.size(); ++i) felt[i].set_aside = believed[i].set_aside;
  return felt;
}

Model on_scale(ReadingScale scale, Model model) {
  if (model.level.known) {
    require(scale == ReadingScale::Raw || *model.level.known > 0.0, "Model",
            "level = " + text_of(*model.level.known),
            "must be positive where readings are taken by their logarithm");
    model.level.known = on_scale(scale, *model.level.known);
  }
  return model;
}

/// What level and boundary are of.
Marginals component_of(const Believed& believed, const Model& model, const Marginals& marginals) {
  Marginals component = marginals;
  if (model.field.trend.is_linear)
    component.mean = believed.belief.at_vertices(Part::Detrended).mean;
  return component;
}

/// Of readings whose zero moved, as if it had not.
Believed believed_with_one_zero(const Surface& surface, const Model& model,
                                const std::vector<Palpation>& felt, ConclusionCache& cache) {
  Believed believed = believe(surface, model, felt, cache);
  if (!believed.evidence.contrast_seen) return believed;
  ConclusionCache apart;
  const auto again = [&](std::vector<Palpation> changed) {
    return believe(surface, model, std::move(changed), apart).belief;
  };
  std::vector<ZeroChange> changes = zero_changes(believed.palpations, again, believed.belief);
  if (changes.empty()) return believed;
  believed = believe(surface, model, with_zeros_taken_back(felt, changes), apart);
  believed.evidence.zero_changes = std::move(changes);
  return believed;
}

}  // namespace

Conclusion conclude(const Surface& surface, const Model& model, std::span<const Palpation> readings,
                    ConclusionCache* cache, std::optional<std::uint64_t> sampling_seed) {
  check(model);
  ConclusionCache own;
  std::vector<Palpation> felt = felt_among(readings, model);
  const ReadingScale scale = model.contrast.scale;
  const Model scaled = on_scale(scale, model);
  // Equations (1) and (2), and whether they show more than noise.
  Believed believed = believed_with_one_zero(surface, scaled, on_scale(scale, felt),
                                             cache != nullptr ? *cache : own);
  for (Palpation& one : believed.evidence.standing_alone)
    one.reading = as_reading(scale, one.reading);
  Marginals marginals = believed.belief.at_vertices();
  Marginals component = component_of(believed, model, marginals);
  // The level (section V.3, equation 4) and its level set.
  BoundaryFit boundary = find_boundary(surface, scaled, believed, component, sampling_seed);
  std::optional<Certainty> certainty;
  if (boundary.level && believed.belief.site_count() > 0)
    certainty = certainty_of(surface, scaled, believed, component, boundary);

  const double tip_m = model.field.probe.indenter_radius_m;
  std::optional<Contour> contour;
  if (boundary.level) {
    if (tip_m > 0.0 && !readings.empty())
      component.mean = eroded(surface, component.mean, tip_m).field;
    const Field* const depth = boundary.depth();
    contour = depth != nullptr ? Contour{eroded(surface, *depth, tip_m).field, 0.0}
                               : Contour{component.mean, boundary.level->value};
    contour->tip_hides_all = tip_m > 0.0 && depth != nullptr && depth->maxCoeff() >= 0.0 &&
                             contour->field.maxCoeff() < 0.0;
  }
  Conclusion conclusion{model,
                        as_made(std::move(felt), believed.palpations),
                        std::move(believed.belief),
                        std::move(marginals),
                        std::move(component),
                        std::move(believed.evidence),
                        believed.lag,
                        boundary.level,
                        std::move(boundary.edge),
                        std::move(boundary.outlines),
                        std::move(contour),
                        std::move(certainty)};
  take_out_weak_parts(conclusion);
  return conclusion;
}

std::optional<Level> level_in_readings(const Conclusion& conclusion) {
  if (!conclusion.level) return std::nullopt;
  Level level{.value = as_reading(conclusion.scale(), conclusion.level->value), .stddev = {}};
  if (conclusion.level->stddev)
    level.stddev =
        *conclusion.level->stddev * reading_per_step(conclusion.scale(), conclusion.level->value);
  return level;
}

std::vector<Misfit> misfits(const Conclusion& conclusion) {
  std::vector<Misfit> found;
  if (conclusion.edge) found = conclusion.edge->misfits();
  const std::optional<Misfit> change = changed_since(conclusion.belief);
  if (change && change->kind == MisfitKind::Moved) found.push_back(*change);
  std::ranges::stable_sort(found, std::greater{}, &Misfit::evidence);
  const auto changed = [](const Misfit& one) { return one.kind != MisfitKind::WeakerPart; };
  if (const auto strongest = std::ranges::find_if(found, changed); strongest != found.end())
    found.erase(std::remove_if(strongest + 1, found.end(), changed), found.end());
  return found;
}

}  // namespace palpation
