// experiment detection: healthy tissue holds nothing, a tumour of the size that was ruled out is
// not missed, and a small one beside a large one is found.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "experiments/experiment.h"
#include "experiments/lazy_tissue.h"
#include "experiments/paper_scene.h"
#include "palpation/base/error.h"
#include "palpation/world/tumour.h"
#include "scene/words.h"
#include "scene/worlds.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

constexpr std::uint64_t kPlaceStream = 0x706c616365u;
constexpr std::array kNoises = {0.01, 0.05, 0.10, 0.25};
constexpr std::array kNoisesOfTwo = {0.01, 0.05, 0.10};
constexpr double kLargeRadius_m = 0.006, kSmallRadius_m = 0.003;
/// Between the two outlines: nearer, they are one to any probe.
constexpr double kLeastGap_m = 0.004;
constexpr int kBatchesOfTwo = 14;  // of 10 after 15 readings: 155

Episode episode_of(const Scene& scene, const Surface& surface) {
  return run_episode(scene, surface, simulated_world(scene, surface));
}

json disk_at(const Vec2& centre_m, double radius_m) {
  return disk_mm(centre_m.x() * 1e3, centre_m.y() * 1e3, radius_m * 1e3)[0];
}

Vec2 random_place(Random& random, const Surface& surface, double margin_m) {
  const Vec2 least = surface.chart().uv.colwise().minCoeff().transpose(),
             most = surface.chart().uv.colwise().maxCoeff().transpose();
  const Vec2 room = (most - least).array() - 2.0 * margin_m;
  const double right = random.uniform(), up = random.uniform();
  return least + Vec2(margin_m + right * room.x(), margin_m + up * room.y());
}

bool overlaps(const Surface& surface, const Episode& episode, const json& disk,
              double least_share) {
  const Vec3 centre =
      Vec3(disk["centre_mm"][0].get<double>(), disk["centre_mm"][1].get<double>(), 0.0) / 1000.0;
  const double radius = disk["radius_mm"].get<double>() / 1000.0;
  const std::vector<Tumour> tumour = {Disk{.centre_m = centre, .radius_m = radius}};
  const Region region = superlevel_region(surface, signed_distance(surface, tumour), 0.0);
  const OverlapAreas areas = overlap_areas(episode.estimate, region);
  return areas.both_m2 > least_share * region.area();
}

Figures figures_of(const char* row, double noise, const std::optional<double>& diameter_m,
                   bool good) {
  return Figures()
      .set("row", row)
      .set("noise", noise)
      .set("diameter_mm", diameter_m ? std::optional(*diameter_m * 1e3) : std::nullopt)
      .set("good", good);
}

/// Healthy tissue, in which nothing should be found, and the same run with a tumour of the diameter
/// that it ruled out, which should.
std::vector<Figures> healthy_and_planted(const Scene& base, const Surface& surface,
                                         std::uint64_t seed) {
  const Scene scene = base.with("seed", seed);
  const double noise = base.number("probe.noise");
  const Episode healthy = episode_of(scene, surface);
  const bool nothing_found = healthy.estimate.empty();
  const std::optional<double> ruled_out_m =
      nothing_found ? diameter_ruled_out_m(healthy) : std::nullopt;
  std::vector<Figures> rows = {figures_of("healthy", noise, ruled_out_m, nothing_found)};
  if (!ruled_out_m) return rows;
  Random random(seed ^ kPlaceStream);
  const json disks = json::array({disk_at(random_place(random, surface, 0.0), 0.5 * *ruled_out_m)});
  const Episode planted = episode_of(scene.with("probe.tumours", disks), surface);
  rows.push_back(
      figures_of("planted", noise, ruled_out_m, overlaps(surface, planted, disks[0], 0.0)));
  return rows;
}

std::vector<Figures> two_tumours(const Scene& base, const Surface& surface, std::uint64_t seed) {
  Random random(seed ^ kPlaceStream);
  const Vec2 large = random_place(random, surface, kLargeRadius_m + 0.001);
  Vec2 small = random_place(random, surface, kSmallRadius_m + 0.001);
  while ((small - large).norm() < kLargeRadius_m + kSmallRadius_m + kLeastGap_m)
    small = random_place(random, surface, kSmallRadius_m + 0.001);
  const json disks = json::array({disk_at(large, kLargeRadius_m), disk_at(small, kSmallRadius_m)});
  const Episode episode = episode_of(base.with("seed", seed).with("probe.tumours", disks), surface);
  const bool both =
      overlaps(surface, episode, disks[0], 0.5) && overlaps(surface, episode, disks[1], 0.5);
  return {figures_of("two", base.number("probe.noise"), std::nullopt, both)};
}

/// The rows of this kind, a line per noise; returns their lines of the table.
std::string report_rows(const Results& results, const std::string& row, const std::string& words) {
  std::printf("%s\n", words.c_str());
  std::string csv;
  for (const double noise : kNoises) {
    std::vector<Figures> runs;
    for (const Row& one : results.rows) {
      if (one.figures.word("row") == row && one.figures.number("noise") == noise)
        runs.push_back(one.figures);
    }
    if (runs.empty()) continue;
    const int count = static_cast<int>(runs.size());
    const auto good = static_cast<int>(
        std::ranges::count_if(runs, [](const Figures& run) { return run.flag("good"); }));
    const std::vector<double> diameters = values_of(runs, "diameter_mm");
    const Interval interval = wilson_interval(good, count);
    std::printf("  noise %2.0f %%: %d of %d, %.1f %%", 100.0 * noise, good, count,
                100.0 * good / count);
    if (!diameters.empty())
      std::printf("; diameter %.1f mm on average", statistics(diameters).mean);
    std::printf("\n");
    csv += row + "," + text_of(noise) + "," + std::to_string(count) + "," + std::to_string(good) +
           "," + text_of(interval.low) + "," + text_of(interval.high) + "," +
           (diameters.empty() ? "" : text_of(statistics(diameters).mean)) + "\n";
  }
  return csv;
}

/// The paper's search area, unless a scene is given: 155 touches of a larger one leave gaps as wide
/// as the small tumour.
Scene scene_of_two(const Scene& base, bool is_given) {
  return (is_given ? base
                   : base.with("surface.plane.size_mm", {25, 50})
                         .with("surface.plane.vertices", {51, 101}))
      .with("plan.initial.count", 15)
      .with("plan.batches", kBatchesOfTwo);
}

}  // namespace

Study detection_study(const ExperimentArguments& arguments) {
  const Scene base = base_scene(arguments, random_tumours_scene());
  const Scene longer = scene_of_two(base, !arguments.scene.empty());
  Study study;
  for (const double noise : kNoises)
    study.cells.push_back(
        {"healthy and planted, noise " + text_of(noise), base.with("probe.noise", noise)});
  for (const double noise : kNoisesOfTwo)
    study.cells.push_back(
        {"two tumours, noise " + text_of(noise), longer.with("probe.noise", noise)});
  study.columns = {"row", "noise", "diameter_mm", "good"};
  const LazyTissue tissue(base), tissue_of_two(longer);
  study.mesh_digest = [=](std::size_t cell) {
    return (cell < kNoises.size() ? tissue : tissue_of_two).mesh_digest();
  };
  study.run = [=, cells = study.cells](std::size_t cell, std::uint64_t seed) {
    return cell < kNoises.size() ? healthy_and_planted(cells[cell].scene, tissue.surface(), seed)
                                 : two_tumours(cells[cell].scene, tissue_of_two.surface(), seed);
  };
  return study;
}

void report_detection(const Results& results, const ReportFolder& folder) {
  std::string csv = "row,noise,runs,good,good_low_95,good_high_95,diameter_mm\n";
  csv += report_rows(results, "healthy", "Healthy tissue: nothing found");
  csv += report_rows(results, "planted", "A tumour of the diameter that was ruled out: found");
  csv += report_rows(
      results, "two",
      "Two tumours, of radius 6 and 3 mm, 155 readings: both found, half of each at least");
  folder.write("detection", csv);
}

}  // namespace palpation::tool
