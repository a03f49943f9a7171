#include "palpation/exploration/exploration.h"

#include <algorithm>
#include <utility>

#include "exploration/field_fit.h"
#include "geometry/settled_point.h"

namespace palpation {
namespace {

/// Goes on until something else is reason to stop.
Plan without_promise(Plan plan) {
  plan.stop.error_m2 = plan.stop.band_m = 0.0;
  return plan;
}

}  // namespace

Exploration::Exploration(Surface surface, Model model, Plan plan, Reach reach,
                         std::optional<std::uint64_t> outlines_seed)
    : surface_(std::move(surface)),
      plan_(std::move(plan)),
      reach_(std::move(reach)),
      outlines_seed_(outlines_seed),
      conclusion_(conclude(surface_, model, {}, &cache_)),
      choice_(choose(surface_, conclusion_, plan_, progress_, reach_)) {}

void Exploration::record(std::span<const Palpation> palpations) {
  std::vector<bool> answered(static_cast<std::size_t>(surface_.vertex_count()), false);
  for (const Palpation& palpation : palpations) {
    if (const int vertex = surface_.vertex_at(palpation.where); vertex >= 0)
      answered[vertex] = true;
  }
  std::vector<Palpation> told(palpations.begin(), palpations.end());
  for (const int stop : next()) {
    if (!answered[stop]) told.push_back(missed_at(surface_.at_vertex(stop)));
  }
  learn_from(told);
}

void Exploration::take_up(std::span<const Palpation> palpations) { learn_from(palpations); }

void Exploration::learn_from(std::span<const Palpation> fresh) {
  std::vector<Palpation> readings = readings_;
  for (Palpation reading : fresh) {
    reading.batch = std::max(reading.batch, progress_.batches);
    reading.where = settled_point(surface_, reading.where);
    readings.push_back(std::move(reading));
  }
  ConclusionCache cache = cache_;
  // The field (equations 1 and 2), the level at its edge (4), the boundary and how sure it is.
  Conclusion conclusion = conclude(surface_, conclusion_.model, readings, &cache);
  Progress progress = progress_of(surface_, conclusion, plan_, readings, &progress_);
  // What the acquisition finds best (equation 3), batch by batch, until enough is known.
  Choice choice = choose(surface_, conclusion, plan_, progress, reach_);
  std::optional<Conclusion> drawn;
  if (outlines_seed_ && choice.stops.empty() &&
      choice.stop_reason == enough_known(conclusion, plan_.stop)) {
    drawn = conclude(surface_, conclusion.model, readings, &cache, outlines_seed_);
    if (enough_known(*drawn, plan_.stop).empty())
      choice = choose(surface_, conclusion, without_promise(plan_), progress, reach_);
  }
  // All of the step, or nothing: from here on nothing throws.
  readings_ = std::move(readings);
  cache_ = std::move(cache);
  conclusion_ = std::move(conclusion);
  progress_ = std::move(progress);
  choice_ = std::move(choice);
  drawn_ = std::move(drawn);
}

void Exploration::draw_outlines(std::uint64_t seed) {
  conclusion_ = drawn_ && outlines_seed_ == seed
                    ? *drawn_
                    : conclude(surface_, conclusion_.model, readings_, &cache_, seed);
}

void Exploration::foresee() {
  if (next().empty() || !grows(conclusion_.model.field, conclusion_.palpations)) return;
  std::vector<SurfacePoint> places;
  for (const int stop : next()) places.push_back(surface_.at_vertex(stop));
  cache_.foresee(places);
}

std::vector<Palpation> Exploration::readings() const {
  std::vector<Palpation> readings = readings_;
  auto felt = conclusion_.palpations.begin();
  for (Palpation& reading : readings) {
    if (reading.kind != TouchKind::Missed) reading = *felt++;
  }
  return readings;
}

}  // namespace palpation
