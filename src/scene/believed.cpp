#include "scene/believed.h"

#include <cmath>
#include <optional>

#include "scene/boundary_curves.h"
#include "scene/summary.h"

namespace palpation::tool {
namespace {

std::string word_of(TouchKind kind) {
  if (kind == TouchKind::Missed) return "missed";
  return kind == TouchKind::Way ? "way" : "stop";
}

std::vector<results::Touch> touches_of(const Exploration& exploration) {
  std::vector<results::Touch> touches;
  for (const Palpation& one : exploration.readings()) {
    results::Touch touch{.number = static_cast<int>(touches.size()) + 1,
                         .place = exploration.surface().position(one.where),
                         .reading = std::nullopt,
                         .batch = one.batch,
                         .kind = word_of(one.kind),
                         .set_aside = one.set_aside};
    if (std::isfinite(one.reading)) touch.reading = one.reading;
    touches.push_back(std::move(touch));
  }
  return touches;
}

}  // namespace

NamedFields believed_fields(const Episode& episode, const World* world) {
  const Snapshot now = snapshot(episode);
  NamedFields fields{{"mean", now.mean}, {"stddev", now.stddev}, {"acquisition", now.acquisition}};
  if (now.mean_detrended.size() > 0) fields.emplace_back("mean_detrended", now.mean_detrended);
  if (now.above_level.size() > 0) fields.emplace_back("above_level", now.above_level);
  for (const Misfit& change : episode.conclusion().evidence.taken_back) {
    if (change.kind == MisfitKind::Waves) fields.emplace_back("waves", change.background.waves);
  }
  if (now.score.size() > 0) {
    fields.emplace_back("score", now.score);
    fields.emplace_back("probability_inside", now.probability_inside);
  }
  if (now.undetected_mm.size() > 0) fields.emplace_back("undetected_mm", now.undetected_mm);
  if (world != nullptr) fields.emplace_back("truth", world->truth);
  return fields;
}

std::vector<BoundaryCurve> believed_curves(const Scene& scene, const Episode& episode,
                                           const World* world) {
  const Surface& surface = episode.exploration.surface();
  std::vector<BoundaryCurve> curves;
  const auto add = [&](const Field& field, double level, CurveKind kind) {
    const std::vector<BoundaryCurve> more = boundary_curves(surface, field, level, kind);
    curves.insert(curves.end(), more.begin(), more.end());
  };
  if (episode.conclusion().level && episode.conclusion().belief.site_count() > 0) {
    const Contour& contour = *episode.conclusion().contour;
    add(contour.field, contour.level, CurveKind::Estimate);
  }
  if (const std::optional<Certainty>& certainty = episode.conclusion().certainty) {
    add(certainty->score, certainty->band_score, CurveKind::BandInner);
    add(certainty->score, -certainty->band_score, CurveKind::BandOuter);
    add(certainty->score, Certainty::cut_score(scene.number("band.cut_risk")), CurveKind::Cut);
  }
  if (world != nullptr) add(world->truth, world->true_level, CurveKind::Truth);
  return curves;
}

results::Run believed_run(const Scene& scene, const Tissue& tissue, const Episode& episode,
                          const std::vector<std::string>& warnings) {
  results::Run run;
  run.tissue.mesh = tissue.surface.mesh();
  run.tissue.frame = tissue.frame;
  for (auto& [name, field] : believed_fields(episode, nullptr))
    run.tissue.fields[name] = std::move(field);
  for (BoundaryCurve& curve : believed_curves(scene, episode, nullptr))
    run.curves.push_back({name_of(curve.kind), curve.part, curve.hole, std::move(curve.points)});
  run.touches = touches_of(episode.exploration);
  run.knows_touches = true;
  run.summary = summary_of(episode, scene, warnings);
  return run;
}

}  // namespace palpation::tool
