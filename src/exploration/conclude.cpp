#include <algorithm>
#include <cmath>
#include <utility>

#include "boundary/erosion.h"
#include "certainty/doubts.h"
#include "exploration/change_search.h"
#include "exploration/doubtful_parts.h"
#include "exploration/likelier_scale.h"
#include "exploration/taken_back.h"
#include "exploration/weak_parts.h"
#include "palpation/boundary/level_set.h"
#include "palpation/exploration/conclusion.h"
#include "palpation/readings/screening.h"
#include "readings/lost_contact.h"
#include "readings/saturation.h"
#include "readings/way.h"

namespace palpation {
namespace {

/// Whether a reading was set aside for a reason that this model judges anew.
bool is_judged_anew(const Palpation& palpation, const Model& model) {
  const std::string& reason = palpation.set_aside;
  if (reason == kStandsAlone) return model.needs_contrast();
  return std::ranges::count(kReasonsAnywhere, reason) > 0 ||
         (model.field.probe.screening && std::ranges::count(kReasonsOfScans, reason) > 0);
}

/// Those that were made, as they were made.
std::vector<Palpation> felt_among(const Surface& surface, std::span<const Palpation> readings,
                                  const Model& model) {
  std::vector<Palpation> felt;
  for (const Palpation& reading : with_travel(surface, {readings.begin(), readings.end()})) {
    if (reading.kind == TouchKind::Missed) continue;
    felt.push_back(reading);
    if (is_judged_anew(reading, model)) felt.back().set_aside.clear();
  }
  return felt;
}

/// With what ends of the sensor's range tell of each. What lost contact is no end.
std::vector<Palpation> bounded(const Surface& surface, std::vector<Palpation> felt) {
  std::vector<Vec3> places;
  for (const Palpation& one : felt) places.push_back(surface.position(one.where));
  std::vector<Palpation> touching = felt;
  for (const std::size_t number : lost_contact(felt, places))
    touching[number].set_aside = kNoContact;
  for (Palpation& one : felt) one.bound = Bound::None;
  for (const Saturation& saturation : saturations_of(touching)) {
    for (Palpation& one : felt) {
      if (saturation.ends(one)) one.bound = saturation.is_upper ? Bound::AtLeast : Bound::AtMost;
    }
  }
  return felt;
}

/// Whether errors or waves alone make the readings about as probable as the edge does, or more so.
bool may_be_no_tumour(const Evidence& evidence) {
  return evidence.of_edge && evidence.of_edge->log_odds < surprising();
}

/// Another's, where its band is as wide as it is by itself.
Field score_beside(const Certainty& certainty, const Certainty& other) {
  return certainty.band_score / other.band_score * other.score;
}

/// The step that tissue or the zero may have made is taken for tissue; were it the zero's, nothing
/// or another outline is left.
Certainty doubted_by_step(Certainty certainty, const Surface& surface, const Model& model,
                          const std::vector<Palpation>& felt, const Evidence& evidence) {
  const std::vector<Palpation> readings =
      with_changes_taken_back(surface, felt, evidence.taken_back);
  ConclusionCache apart;
  const Known other = known_by(
      surface, model,
      believe(surface, model,
              with_changes_taken_back(surface, readings, {&*evidence.zero_or_tissue, 1}), apart));
  std::optional<Field> score;
  if (other.boundary.edge)
    score = score_beside(
        certainty, certainty_of(surface, model, other.believed, other.component, other.boundary));
  return as_likely_another(std::move(certainty), surface, score);
}

/// The scale that readings are even on is not known.
Certainty doubted_by_scale(Certainty certainty, const Surface& surface, const Model& model,
                           const Known& other) {
  const Field score = score_beside(
      certainty, certainty_of(surface, model, other.believed, other.component, other.boundary));
  return as_likely_another(std::move(certainty), surface, score);
}

/// Readings before and since put the outline elsewhere: which of them are right is not known.
Certainty doubted_by_outline(Certainty certainty, const Surface& surface,
                             const BoundaryFit& boundary, const Misfit& since) {
  return doubted_as_a_whole(std::move(certainty), surface, *boundary.offset_sd(), since.rms);
}

}  // namespace

Conclusion conclude(const Surface& surface, const Model& model, std::span<const Palpation> readings,
                    ConclusionCache* cache, std::optional<std::uint64_t> sampling_seed) {
  check(model);
  ConclusionCache own;
  if (cache == nullptr) cache = &own;
  std::vector<Palpation> felt =
      bounded(surface, live(surface, felt_among(surface, readings, model)));
  // Equations (1) and (2), and whether they show more than noise.
  // The level (section V.3, equation 4) and its level set.
  auto [likelier, other] = on_likelier_scale(surface, model, felt, *cache, sampling_seed);
  auto& [scale, modelled, known] = likelier;
  auto& [believed, marginals, component, boundary] = known;
  const Model scaled = on_scale(scale, model);
  believed.evidence.scale = scale;
  for (Palpation& one : believed.evidence.standing_alone)
    one.reading = as_reading(scale, one.reading);
  const double tip_m = model.field.probe.indenter_radius_m;
  if (sampling_seed) draw_outlines(boundary, scaled, believed, *sampling_seed);
  if (other) {
    draw_outlines(other->known.boundary, model, other->known.believed, *sampling_seed);
    believed.evidence.area_by_logarithms_m2 =
        superlevel_area(surface, eroded(surface, *other->known.boundary.depth(), tip_m).field, 0.0);
  }
  std::optional<Certainty> certainty;
  if (scaled.band && boundary.level && believed.belief.site_count() > 0)
    certainty = certainty_of(surface, scaled, believed, component, boundary);
  if (certainty && believed.evidence.another_outline)
    certainty = doubted_by_outline(*std::move(certainty), surface, boundary,
                                   *believed.evidence.another_outline);
  if (certainty && believed.evidence.zero_or_tissue)
    certainty =
        doubted_by_step(*std::move(certainty), surface, scaled, modelled, believed.evidence);
  if (certainty && other)
    certainty = doubted_by_scale(*std::move(certainty), surface, model, other->known);
  if (certainty && may_be_no_tumour(believed.evidence))
    certainty = as_likely_another(*std::move(certainty), surface, std::nullopt);

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
  doubt_weaker_parts(conclusion);
  doubt_parts_along_border(conclusion);
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

std::vector<SessionChange> session_changes(const Conclusion& conclusion) {
  std::vector<SessionChange> sessions;
  for (const Misfit& change : conclusion.evidence.taken_back) {
    if (change.session == 0 || change.kind != MisfitKind::Zero) continue;
    SessionChange& session = sessions.emplace_back(change);
    for (const Misfit& gain : conclusion.evidence.taken_back) {
      const double factor = 1.0 + gain.amount;
      if (gain.kind == MisfitKind::Gain && gain.session == change.session)
        session.gain = {factor, factor, factor};
    }
    if (!conclusion.outlines) continue;
    for (const ChangeLeft& left : conclusion.outlines->left) {
      if (left.change.session != change.session) continue;
      if (left.change.kind == MisfitKind::Gain) {
        const double taken_back = 1.0 + left.change.amount;
        session.gain = {taken_back * left.gain.mean, taken_back * left.gain.least,
                        taken_back * left.gain.most};
      } else {
        session.zero.amount += left.step.value;
        session.zero.stddev = *left.step.stddev;
      }
    }
  }
  return sessions;
}

std::vector<Misfit> other_changes(const Conclusion& conclusion) {
  std::vector<Misfit> others = conclusion.evidence.taken_back;
  std::erase_if(others, [](const Misfit& change) { return change.session > 0; });
  std::ranges::stable_sort(
      others, {}, [](const Misfit& change) { return std::pair(change.from_batch, change.number); });
  return others;
}

std::vector<Palpation> readings_as_if_unchanged(const Conclusion& conclusion) {
  return with_changes_taken_back(conclusion.belief.prior().surface(),
                                 on_scale(conclusion.scale(), conclusion.palpations),
                                 conclusion.evidence.taken_back);
}

std::vector<Misfit> misfits(const Conclusion& conclusion) {
  const std::vector<Palpation> readings = readings_as_if_unchanged(conclusion);
  std::vector<Misfit> found = misfits_of(on_scale(conclusion.scale(), conclusion.model),
                                         conclusion.edge, conclusion.belief, readings);
  if (!conclusion.outlines) return found;
  // What a session's zero and gain explain is drawn with the outlines, and what stands out beside
  // the edge may lie in them.
  const Surface& surface = conclusion.belief.prior().surface();
  std::erase_if(found, [&](const Misfit& misfit) {
    const bool is_held = misfit.kind == MisfitKind::WeakerPart && misfit.amount > 0.0 &&
                         misfit.where &&
                         surface.interpolate(conclusion.outlines->depth, *misfit.where) > 0.0;
    return is_held ||
           as_of_its_session(misfit, conclusion.evidence.taken_back, readings).session > 0;
  });
  return found;
}

}  // namespace palpation
