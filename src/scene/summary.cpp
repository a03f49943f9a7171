#include "scene/summary.h"

#include <cmath>
#include <optional>
#include <utility>

#include "scene/modelled.h"
#include "scene/parts.h"
#include "scene/remarks.h"
#include "scene/setup.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

constexpr double kMm2 = 1e6;  // in a square metre
constexpr double kMm = 1e3;   // in a metre

json maybe(const std::optional<double>& value, double factor = 1.0) {
  if (value.has_value()) return *value * factor;
  return nullptr;
}

json error_json(const RegionError& error, double search_area_m2) {
  return {{"symmetric_difference_mm2", error.symmetric_difference_m2 * kMm2},
          {"missed_mm2", error.missed_m2 * kMm2},
          {"extra_mm2", error.extra_m2 * kMm2},
          {"percent_of_search_area", 100.0 * error.symmetric_difference_m2 / search_area_m2},
          {"dice", error.dice},
          {"hausdorff_mm", maybe(error.hausdorff_m, kMm)},
          {"mean_distance_mm", maybe(error.mean_distance_m, kMm)}};
}

json pair_mm(const Vec2& place_m) { return {place_m.x() * kMm, place_m.y() * kMm}; }

/// One part or hole, in chart millimetres.
json place_json(const TumourPart& part) {
  return {{"area_mm2", std::abs(part.area_m2) * kMm2},
          {"centroid_mm", pair_mm(part.centroid_m)},
          {"extent_mm", pair_mm(part.most_m - part.least_m)}};
}

json part_json(const TumourPart& part, const Surface& surface) {
  json result = place_json(part);
  result["position_mm"] = {part.position_m.x() * kMm, part.position_m.y() * kMm,
                           part.position_m.z() * kMm};
  result["probability"] = maybe(part.probability);
  result["touches_border"] = part.touches_border;
  result["contrast_of_strongest"] =
      part.contrast ? json(part.contrast->of_strongest) : json(nullptr);
  result["contrast_sd"] = part.contrast ? json(part.contrast->stddev) : json(nullptr);
  result["holes"] = json::array();
  for (const Ring& hole : part.polygon.holes)
    result["holes"].push_back(place_json(measured(hole, surface)));
  return result;
}

/// Of a tumour of two heights; null of others.
json core_json(const std::optional<DrawnCore>& core, const Surface& surface) {
  if (!core) return nullptr;
  const Vec3 at = surface.position(core->where);
  return {{"position_mm", {at.x() * kMm, at.y() * kMm, at.z() * kMm}},
          {"probability", core->probability},
          {"area_mm2", core->area_m2.mean * kMm2},
          {"beside", core->beside.mean},
          {"beside_interval", {core->beside.least, core->beside.most}},
          {"with_mm2", core->with_m2 * kMm2},
          {"without_mm2", core->without_m2 * kMm2}};
}

json wandering_json(const std::optional<WanderingPlaces>& wandering) {
  if (!wandering) return nullptr;
  return {{"way_mm", wandering->way_m.mean * kMm},
          {"way_interval_mm", {wandering->way_m.least * kMm, wandering->way_m.most * kMm}},
          {"lasting", wandering->lasting.mean},
          {"farthest_number", wandering->farthest + 1},
          {"farthest_mm", wandering->farthest_m * kMm}};
}

/// What the band and the cut line enclose, and what is expected to be wrong; null where nothing is
/// known of a boundary.
void add_certainty(json& summary, const Episode& episode, double cut_risk) {
  for (const char* key : {"certainty", "area_interval_mm2", "plateau_probability", "noise_inside",
                          "core", "wandering", "expected_missed_mm2", "expected_extra_mm2",
                          "expected_untouched_mm2", "band", "cut"})
    summary[key] = nullptr;
  if (!episode.conclusion().model.band) summary["certainty"] = "off";
  const std::optional<Certainty>& certainty = episode.conclusion().certainty;
  if (!certainty || episode.conclusion().tip_hides_all()) return;
  const Surface& surface = episode.exploration.surface();
  const std::optional<OutlinePosterior>& outlines = episode.conclusion().outlines;
  summary["certainty"] = outlines ? "sampled" : "laplace";
  if (outlines && episode.conclusion().model.field.probe.indenter_radius_m == 0.0)
    summary["area_interval_mm2"] = {outlines->area_m2.least * kMm2, outlines->area_m2.most * kMm2};
  if (outlines) {
    summary["plateau_probability"] = outlines->plateau_probability;
    summary["noise_inside"] = outlines->noise_inside.mean;
    summary["core"] = core_json(outlines->core, surface);
    summary["wandering"] = wandering_json(outlines->misfit.wandering);
  }
  const double q = certainty->band_score, cut = Certainty::cut_score(cut_risk);
  summary["expected_missed_mm2"] = certainty->expected.missed_m2 * kMm2;
  summary["expected_extra_mm2"] = certainty->expected.extra_m2 * kMm2;
  summary["expected_untouched_mm2"] = certainty->untouched_error_m2 * kMm2;
  summary["band"] = {{"probability", certainty->probability},
                     {"score", q},
                     {"half_width_mm", certainty->half_width_m * kMm},
                     {"inner_area_mm2", superlevel_area(surface, certainty->score, q) * kMm2},
                     {"outer_area_mm2", superlevel_area(surface, certainty->score, -q) * kMm2}};
  summary["cut"] = {{"risk", cut_risk},
                    {"score", cut},
                    {"area_mm2", superlevel_area(surface, certainty->score, cut) * kMm2}};
}

/// What is in force of field.reduced_rank: null where the belief is exact.
json reduced_rank_json(const Belief& belief) {
  const std::optional<ReducedRank> reduced = belief.reduced_rank();
  if (!reduced) return nullptr;
  return {{"rank", reduced->rank},
          {"mean_off_at_most", reduced->mean_error},
          {"variance_off_at_most", reduced->variance_error}};
}

/// Of the search: null where the scene has none.
json goal_json(const std::optional<GoalState>& goal) {
  if (!goal) return nullptr;
  return {{"max_undetected_diameter_mm", goal->diameter_m * kMm},
          {"probability", goal->probability},
          {"undetected_mm", maybe(goal->undetected_m, kMm)},
          {"reached", goal->is_reached()},
          {"touches_needed", goal->touches_needed}};
}

json change_json(const Misfit& change) {
  if (change.kind == MisfitKind::Tilted) {
    const Vec3 slope_per_mm = change.background.slope_per_m / kMm;
    return {{"kind", name_of(change.kind)},
            {"slope_per_mm", {slope_per_mm.x(), slope_per_mm.y(), slope_per_mm.z()}}};
  }
  if (change.kind == MisfitKind::Waves)
    return {{"kind", name_of(change.kind)},
            {"rise", change.background.waves.maxCoeff() - change.background.waves.minCoeff()},
            {"length_mm", kMm * change.background.wave_scale.length_m}};
  if (change.kind == MisfitKind::Drift)
    return {{"kind", name_of(change.kind)},
            {"rise", change.background.drift.maxCoeff() - change.background.drift.minCoeff()},
            {"readings", change.background.errors.readings}};
  if (change.kind == MisfitKind::Late)
    return {{"kind", name_of(change.kind)}, {"lag_mm", kMm * change.amount}};
  json result = {
      {"kind", name_of(change.kind)}, {"batch", change.from_batch}, {"reading", change.number + 1}};
  if (change.kind == MisfitKind::Zero)
    result.update({{"amount", change.amount}, {"amount_sd", change.stddev}});
  if (change.kind == MisfitKind::Gain) result["factor"] = 1.0 + change.amount;
  if (change.kind == MisfitKind::Moved) {
    const Vec3 moved_mm = kMm * change.moved_m;
    result["moved_mm"] = {moved_mm.x(), moved_mm.y(), moved_mm.z()};
  }
  return result;
}

json session_json(const SessionChange& session) {
  json result = change_json(session.zero);
  result["session"] = session.zero.session + 1;
  if (session.gain) {
    result["factor"] = session.gain->mean;
    result["factor_interval"] = {session.gain->least, session.gain->most};
  }
  return result;
}

json doubtful_json(const Conclusion& conclusion) {
  json parts = json::array();
  for (const DoubtfulPart& part : conclusion.evidence.doubtful) {
    const Vec3 at = conclusion.belief.prior().surface().position(part.where);
    json& one = parts.emplace_back(json{{"position_mm", {at.x() * kMm, at.y() * kMm, at.z() * kMm}},
                                        {"area_mm2", part.area_m2 * kMm2}});
    if (part.is_along_border()) one["border_share"] = part.border_share;
  }
  return parts;
}

json taken_back_json(const Conclusion& conclusion) {
  json changes = json::array();
  for (const SessionChange& session : session_changes(conclusion))
    changes.push_back(session_json(session));
  for (const Misfit& change : other_changes(conclusion)) changes.push_back(change_json(change));
  return changes;
}

}  // namespace

json summary_of(const Episode& episode, const Scene& scene, std::vector<std::string> warnings) {
  const Exploration& exploration = episode.exploration;
  const Surface& surface = exploration.surface();
  json parts = json::array();
  for (const TumourPart& part : parts_of(episode)) parts.push_back(part_json(part, surface));
  const std::optional<Level> level = level_in_readings(episode.conclusion());
  const std::vector<std::string> remarks = boundary_remarks(episode);
  warnings.insert(warnings.end(), remarks.begin(), remarks.end());
  json result = {
      {"version", 1},
      {"scene", scene.name()},
      {"seed", scene.seed()},
      {"options", options_in_force(scene)},
      {"computed", surface.computed()},
      {"modelled", modelled(episode.conclusion())},
      {"vertices", surface.vertex_count()},
      {"measurements", episode.conclusion().palpations.size()},
      {"search_area_mm2", surface.area() * kMm2},
      {"level", level ? json(level->value) : json(nullptr)},
      {"level_sd", level ? maybe(level->stddev) : json(nullptr)},
      {"area_mm2", surface_area(surface, episode.estimate) * kMm2},
      {"parts", parts},
      {"expected_error_mm2",
       episode.trace.empty() ? json(nullptr) : maybe(episode.trace.back().expected_error_m2, kMm2)},
      {"path_mm", episode.course.length_m * kMm},
      {"learned",
       {{"length_mm", episode.conclusion().belief.prior().kernel().length_m * kMm},
        {"signal_sd", episode.conclusion().belief.signal_sd()},
        {"noise_sd", std::sqrt(episode.conclusion().belief.noise_variance())}}},
      {"transform", episode.conclusion().scale() == ReadingScale::Log ? "log" : "none"},
      {"transform_is_open", episode.conclusion().evidence.area_by_logarithms_m2.has_value()},
      {"precision", episode.conclusion().belief.options().single_precision ? "single" : "double"},
      {"reduced_rank", reduced_rank_json(episode.conclusion().belief)},
      {"warnings", warnings},
      {"stop_reason", episode.stop_reason().empty() ? json(nullptr) : json(episode.stop_reason())},
      {"chart_hash", surface.chart().hash()}};
  if (field_of(scene).probe.has_lag()) {
    result["lag_mm"] =
        episode.conclusion().lag ? json(episode.conclusion().lag->value_m * kMm) : json(nullptr);
    result["lag_sd_mm"] =
        episode.conclusion().lag ? json(episode.conclusion().lag->stddev_m * kMm) : json(nullptr);
  }
  if (json changes = taken_back_json(episode.conclusion()); !changes.empty())
    result["taken_back"] = std::move(changes);
  if (const std::optional<Misfit>& step = episode.conclusion().evidence.zero_or_tissue)
    result["zero_or_tissue"] = change_json(*step);
  if (json doubtful = doubtful_json(episode.conclusion()); !doubtful.empty())
    result["doubtful"] = std::move(doubtful);
  const bool found = !episode.estimate.empty();
  const json ruled_out = maybe(diameter_ruled_out_m(episode), kMm);
  result["nothing_wider_than_mm"] = found ? json(nullptr) : ruled_out;
  result["no_other_wider_than_mm"] = found ? ruled_out : json(nullptr);
  result["goal"] = goal_json(goal_state(episode));
  add_certainty(result, episode, scene.number("band.cut_risk"));
  if (episode.truth) {
    result["truth_is"] = episode.truth_is;
    result["error"] = episode.error ? error_json(*episode.error, surface.area()) : json(nullptr);
  }
  return result;
}

json comparison_of(const RegionError& error, const Scene& scene, const Surface& surface,
                   const std::vector<std::string>& warnings) {
  return {{"version", 1},
          {"scene", scene.name()},
          {"search_area_mm2", surface.area() * kMm2},
          {"error", error_json(error, surface.area())},
          {"warnings", warnings},
          {"chart_hash", surface.chart().hash()}};
}

}  // namespace palpation::tool
