// experiment coverage --world: how right, and how sure only as far as it is right, on the worlds of
// the catalogue.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "boundary/outline_length.h"
#include "boundary/superlevel_parts.h"
#include "experiments/coverage.h"
#include "experiments/experiment.h"
#include "experiments/lazy_tissue.h"
#include "palpation/base/error.h"
#include "palpation/boundary/level_set.h"
#include "palpation/certainty/reference_bound.h"
#include "palpation/world/catalogue.h"
#include "scene/exit_code.h"
#include "scene/words.h"
#include "scene/worlds.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

/// The strata: a trial's seed says which of each.
constexpr std::array kNoises = {0.01, 0.02, 0.05, 0.12, 0.25};
struct TissueSize {
  const char* name;
  int width_mm, height_mm, columns, rows;
};
constexpr std::array kTissues = {TissueSize{"25 x 50 mm", 25, 50, 51, 101},
                                 TissueSize{"40 x 60 mm", 40, 60, 58, 87},
                                 TissueSize{"54 x 49 mm", 54, 49, 75, 68}};
constexpr std::size_t kBins = 10;
constexpr double kAboutLevel = 0.05;  // of high - low, on both sides

/// Which stratum of each a trial belongs to: a seed of its own for every combination.
struct Stratum {
  std::size_t noise, tissue;
  bool on_the_way;
  explicit Stratum(std::uint64_t seed)
      : noise(seed % kNoises.size()),
        tissue(seed / kNoises.size() % kTissues.size()),
        on_the_way(seed / (kNoises.size() * kTissues.size()) % 2 == 1) {}
};

json tissue_json(const TissueSize& size) {
  return {
      {"plane",
       {{"size_mm", {size.width_mm, size.height_mm}}, {"vertices", {size.columns, size.rows}}}}};
}

json worlds_scene() {
  return {{"version", 1},
          {"surface", tissue_json(kTissues.front())},
          {"probe", {{"kind", "simulated"}, {"low", 7}, {"high", 9}, {"world", "star"}}}};
}

/// A sigmoid's slope that rises as the truth does, on the average over its outline.
double felt_slope_per_m(const Surface& surface, const World& world, double range,
                        double perimeter_m, double fraction) {
  const double about = kAboutLevel * range;
  const double area = superlevel_area(surface, world.truth, world.true_level - about) -
                      superlevel_area(surface, world.truth, world.true_level + about);
  const double rise_per_m = 2.0 * kAboutLevel * perimeter_m / area;
  return rise_per_m / (fraction * (1.0 - fraction));
}

/// Of the parts of one region, how many the other does not touch.
int parts_apart(const std::vector<std::vector<int>>& parts, const Field* other, double level) {
  return static_cast<int>(std::ranges::count_if(parts, [&](const std::vector<int>& part) {
    return other == nullptr ||
           std::ranges::none_of(part, [&](int vertex) { return (*other)[vertex] >= level; });
  }));
}

/// Of the true outline, the part at which P(inside) falls in each tenth: a tenth each where it is
/// honest.
std::vector<double> outline_in_tenths(const Surface& surface, const std::vector<LevelLoop>& loops,
                                      const Field& probability) {
  std::vector<double> tenths(kBins, 0.0);
  double all = 0.0;
  for (const LevelLoop& loop : loops) {
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      const double length = piece_length(surface, loop, i);
      const double p = surface.interpolate(probability, loop.points[i]);
      tenths[std::min(kBins - 1, static_cast<std::size_t>(kBins * p))] += length;
      all += length;
    }
  }
  for (double& part : tenths) part = all > 0.0 ? part / all : 0.0;
  return tenths;
}

/// By tenths of P(inside): area, and how much of it is tumour, mm2.
void add_reliability(const Surface& surface, const World& world, const Field& probability,
                     Figures& row) {
  std::vector<double> area(kBins, 0.0), tumour(kBins, 0.0);
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    const auto bin = std::min(kBins - 1, static_cast<std::size_t>(kBins * probability[vertex]));
    const double here = surface.vertex_areas()[vertex] * 1e6;
    area[bin] += here;
    if (world.truth[vertex] >= world.true_level) tumour[bin] += here;
  }
  row.set("area_by_p", list_text(area)).set("tumour_by_p", list_text(tumour));
}

/// What surprised, and by how many nats; and by how many millimetres places wander.
std::string misfit_text(const Conclusion& conclusion) {
  std::string text;
  for (const Misfit& one : conclusion.evidence.taken_back)
    text += (text.empty() ? "" : " ") + std::string(name_of(one.kind)) +
            "-back=" + reading_text(one.amount);
  for (const Misfit& one : misfits(conclusion))
    text +=
        (text.empty() ? "" : " ") + std::string(name_of(one.kind)) + "=" + fixed(one.evidence, 1);
  if (conclusion.outlines && conclusion.outlines->misfit.wandering)
    text += (text.empty() ? "" : " ") +
            ("wandering-mm=" + fixed(conclusion.outlines->misfit.wandering->way_m.mean * 1e3, 2));
  return text;
}

Figures run_of(const Scene& scene, const Surface& surface) {
  const World world = simulated_world(scene, surface);
  const Episode episode = run_episode(scene, surface, world);
  const Conclusion& conclusion = episode.conclusion();
  const std::vector<LevelLoop> outline = level_loops(surface, world.truth, world.true_level);
  const double perimeter_m = outline_length(surface, outline),
               fraction = scene.number("level.fraction"),
               range = scene.number("probe.high") - scene.number("probe.low");
  Figures row = against_truth(episode, world);
  row.set("misfits", misfit_text(conclusion));
  const bool has_tumour = perimeter_m > 0.0;
  row.set("has_tumour", has_tumour);
  const Field* found = conclusion.contour ? &conclusion.contour->field : nullptr;
  const double level = conclusion.contour ? conclusion.contour->level : 0.0;
  const auto truth_parts = superlevel_parts(surface, world.truth, world.true_level);
  row.set("true_parts", static_cast<double>(truth_parts.size()))
      .set("missed_parts", static_cast<double>(parts_apart(truth_parts, found, level)))
      .set("false_parts", found == nullptr ? 0.0
                                           : static_cast<double>(parts_apart(
                                                 superlevel_parts(surface, *found, level),
                                                 &world.truth, world.true_level)));
  if (has_tumour) {
    const double slope = felt_slope_per_m(surface, world, range, perimeter_m, fraction);
    const ReferenceBound bound = reference_bound(
        {.perimeter_m = perimeter_m,
         .slope_per_m = slope,
         .noise = scene.number("probe.noise"),
         .readings = std::max(1, static_cast<int>(conclusion.belief.palpations().size())),
         .fraction = fraction});
    row.set("slope_per_m", slope)
        .set("bound_mm2", bound.expected_error_m2 * 1e6)
        .set("bound_half_width_mm",
             bound.band_half_width_m(scene.number("band.probability")) * 1e3);
  }
  if (conclusion.certainty) {
    const Field probability = conclusion.certainty->probability_inside();
    add_reliability(surface, world, probability, row);
    if (has_tumour)
      row.set("outline_by_p", list_text(outline_in_tenths(surface, outline, probability)));
  }
  return row;
}

std::vector<WorldFamily> chosen_families(const std::string& name) {
  std::vector<WorldFamily> chosen;
  std::string all;
  for (const WorldFamily& family : world_families()) {
    if (name == "all" || name == family.name || name == family.kind) chosen.push_back(family);
    all += (all.empty() ? "" : ", ") + family.name;
  }
  if (chosen.empty())
    throw WrongUsage("experiment coverage: --world " + name +
                     ": must be all, a kind (shape, parts, profile, background, sensor, healthy) "
                     "or one of " +
                     all);
  return chosen;
}

}  // namespace

Study worlds_study(const ExperimentArguments& arguments) {
  const bool has_tissue = !arguments.scene.empty();
  const Scene base = base_scene(arguments, worlds_scene());
  refuse_without_certainty(base);
  Study study;
  for (const WorldFamily& family : chosen_families(arguments.material.world))
    study.cells.push_back({family.name, base.with("probe.world", family.name),
                           Figures().set("family", family.name).set("kind", family.kind)});
  study.columns = {"family", "kind", "noise", "tissue", "on_the_way"};
  for (std::string& column : columns_against_truth()) study.columns.push_back(std::move(column));
  study.columns.insert(
      study.columns.end(),
      {"has_tumour", "misfits", "true_parts", "missed_parts", "false_parts", "slope_per_m",
       "bound_mm2", "bound_half_width_mm", "area_by_p", "tumour_by_p", "outline_by_p"});
  study.facts = {{"worlds", arguments.material.world},
                 {"band.probability", text_of(base.number("band.probability"))}};
  std::vector<LazyTissue> tissues;
  for (const TissueSize& size : kTissues)
    tissues.emplace_back(has_tissue ? base : base.with("surface", tissue_json(size)));
  study.mesh_digest = [tissues, has_tissue](std::size_t) {
    if (has_tissue) return tissues.front().mesh_digest();
    std::string all;
    for (const LazyTissue& tissue : tissues) all += (all.empty() ? "" : "+") + tissue.mesh_digest();
    return all;
  };
  study.run = [tissues, has_tissue, cells = study.cells](std::size_t cell, std::uint64_t seed) {
    const Stratum stratum(seed);
    Scene scene = cells[cell].scene.with("seed", seed);
    if (!has_tissue) {
      scene = scene.with("surface", tissue_json(kTissues[stratum.tissue]))
                  .with("probe.noise", kNoises[stratum.noise])
                  .with("plan.readings_along_path", stratum.on_the_way);
    }
    Figures row =
        run_of(scene, has_tissue ? tissues.front().surface() : tissues[stratum.tissue].surface());
    row.set("noise", scene.number("probe.noise"))
        .set("tissue", has_tissue ? "the scene's" : kTissues[stratum.tissue].name)
        .set("on_the_way", scene.truth("plan.readings_along_path"));
    return std::vector{row};
  };
  return study;
}

}  // namespace palpation::tool
