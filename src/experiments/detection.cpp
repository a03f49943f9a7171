// experiment detection: healthy tissue holds nothing, a tumour of the size that was ruled out is
// not missed, and a small one beside a large one is found.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "experiments/experiment.h"
#include "experiments/paper_scene.h"
#include "palpation/base/error.h"
#include "palpation/world/tumour.h"
#include "scene/tissue.h"
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

struct Run {
  std::string row;
  std::uint64_t seed = 0;
  double noise = 0.0;
  std::optional<double> ruled_out_m{};  ///< diameter, of healthy tissue
  bool good = false;                    ///< nothing found, found, both found
};

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

/// Healthy tissue, and the same run with a tumour of the diameter that it ruled out.
std::array<Run, 2> healthy_and_planted(const Scene& base, const Surface& surface,
                                       std::uint64_t seed) {
  const Scene scene = base.with("seed", seed);
  const Episode healthy = episode_of(scene, surface);
  std::array<Run, 2> runs = {
      Run{.row = "healthy", .seed = seed, .noise = base.number("probe.noise")},
      Run{.row = "planted", .seed = seed, .noise = base.number("probe.noise")}};
  runs[0].good = healthy.estimate.empty();
  if (runs[0].good) runs[0].ruled_out_m = runs[1].ruled_out_m = diameter_ruled_out_m(healthy);
  if (!runs[0].ruled_out_m) return runs;
  Random random(seed ^ kPlaceStream);
  const json disks =
      json::array({disk_at(random_place(random, surface, 0.0), 0.5 * *runs[0].ruled_out_m)});
  runs[1].good =
      overlaps(surface, episode_of(scene.with("probe.tumours", disks), surface), disks[0], 0.0);
  return runs;
}

Run two_tumours(const Scene& base, const Surface& surface, std::uint64_t seed) {
  Random random(seed ^ kPlaceStream);
  const Vec2 large = random_place(random, surface, kLargeRadius_m + 0.001);
  Vec2 small = random_place(random, surface, kSmallRadius_m + 0.001);
  while ((small - large).norm() < kLargeRadius_m + kSmallRadius_m + kLeastGap_m)
    small = random_place(random, surface, kSmallRadius_m + 0.001);
  const json disks = json::array({disk_at(large, kLargeRadius_m), disk_at(small, kSmallRadius_m)});
  const Episode episode = episode_of(base.with("seed", seed).with("probe.tumours", disks), surface);
  Run run{.row = "two", .seed = seed, .noise = base.number("probe.noise")};
  run.good = overlaps(surface, episode, disks[0], 0.5) && overlaps(surface, episode, disks[1], 0.5);
  return run;
}

void report(const std::vector<Run>& runs, const std::string& row, const std::string& words) {
  std::printf("%s\n", words.c_str());
  for (const double noise : kNoises) {
    int count = 0, good = 0;
    std::vector<double> diameters;
    for (const Run& run : runs) {
      if (run.row != row || run.noise != noise) continue;
      ++count;
      good += run.good;
      if (run.ruled_out_m) diameters.push_back(*run.ruled_out_m * 1e3);
    }
    if (count == 0) continue;
    std::printf("  noise %2.0f %%: %d of %d, %.1f %%", 100.0 * noise, good, count,
                100.0 * good / count);
    if (!diameters.empty())
      std::printf("; diameter %.1f mm on average", statistics(diameters).mean);
    std::printf("\n");
  }
}

std::string csv_of(const std::vector<Run>& runs) {
  std::string csv = "row,seed,noise,diameter_mm,good\n";
  for (const Run& run : runs) {
    csv += run.row + "," + std::to_string(run.seed) + "," + text_of(run.noise) + "," +
           (run.ruled_out_m ? text_of(*run.ruled_out_m * 1e3) : "") + "," + (run.good ? "1" : "0") +
           "\n";
  }
  return csv;
}

}  // namespace

void detection(const ExperimentArguments& arguments) {
  const Scene base = base_scene(arguments, random_tumours_scene());
  const Tissue tissue = tissue_of(base);
  // The paper's search area, unless a scene is given: 155 touches of a larger one leave gaps as
  // wide as the small tumour.
  const Scene longer =
      (arguments.scene.empty()
           ? base.with("surface.plane.size_mm", {25, 50}).with("surface.plane.vertices", {51, 101})
           : base)
          .with("plan.initial.count", 15)
          .with("plan.batches", kBatchesOfTwo);
  const Tissue tissue_of_two = tissue_of(longer);
  std::vector<Cell> cells;
  for (const double noise : kNoises)
    cells.push_back(
        {"healthy and planted, noise " + text_of(noise), base.with("probe.noise", noise)});
  for (const double noise : kNoisesOfTwo)
    cells.push_back({"two tumours, noise " + text_of(noise), longer.with("probe.noise", noise)});
  if (printed_scenes(cells, arguments)) return;
  std::vector<std::vector<Run>> found(cells.size() * static_cast<std::size_t>(arguments.trials));
  for_trials(cells.size(), arguments, [&](std::size_t cell, std::size_t trial, std::uint64_t seed) {
    std::vector<Run>& runs = found[cell * static_cast<std::size_t>(arguments.trials) + trial];
    if (cell < kNoises.size()) {
      for (const Run& run : healthy_and_planted(cells[cell].scene, tissue.surface, seed)) {
        if (run.row == "healthy" || run.ruled_out_m) runs.push_back(run);
      }
    } else {
      runs.push_back(two_tumours(cells[cell].scene, tissue_of_two.surface, seed));
    }
  });
  std::vector<Run> runs;
  for (const std::vector<Run>& some : found) runs.insert(runs.end(), some.begin(), some.end());
  report(runs, "healthy", "Healthy tissue: nothing found");
  report(runs, "planted", "A tumour of the diameter that was ruled out: found");
  report(runs, "two",
         "Two tumours, of radius 6 and 3 mm, 155 readings: both found, half of each at least");
  write_table(arguments, "detection", csv_of(runs));
}

}  // namespace palpation::tool
