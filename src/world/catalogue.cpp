#include "palpation/world/catalogue.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "palpation/base/error.h"
#include "world/draft.h"

namespace palpation {
namespace {

constexpr double kLeastSlope_per_m = 500.0, kMostSlope_per_m = 2000.0;
constexpr int kChangeAfter = 40;

void move(PhantomDesign& design, const Vec3& by) {
  for (Lump& lump : design.lumps) {
    if (auto* disk = std::get_if<Disk>(&lump.outline)) disk->centre_m += by;
    if (auto* horseshoe = std::get_if<Horseshoe>(&lump.outline)) horseshoe->centre_m += by;
    if (auto* polygon = std::get_if<Outline>(&lump.outline)) {
      for (Vec3& point : polygon->points_m) point += by;
    }
  }
  for (Background& term : design.background) {
    if (auto* vessel = std::get_if<Vessel>(&term)) {
      for (Vec3& point : vessel->line_m) point += by;
    }
  }
}

struct Recipe {
  WorldFamily family;
  void (*draw)(Draft& draft);
};

std::vector<Recipe> shapes() {
  return {
      {{"star", "shape", "a smooth blob"}, [](Draft& d) { add_blob(d); }},
      {{"bent", "shape", "a band along an arc: beans to horseshoes"},
       [](Draft& d) { add_shape(d, ShapeFamily::Bent); }},
      {{"ellipse", "shape", "an ellipse, up to three times as long as wide"},
       [](Draft& d) { add_shape(d, ShapeFamily::Ellipse); }},
      {{"dumbbell", "shape", "two disks and a neck"},
       [](Draft& d) { add_shape(d, ShapeFamily::Dumbbell); }},
      {{"ell", "shape", "an L: corners, one of them inwards"},
       [](Draft& d) { add_shape(d, ShapeFamily::Ell); }},
      {{"points", "shape", "a star of three to seven points"},
       [](Draft& d) { add_shape(d, ShapeFamily::Pointed); }},
      {{"crescent", "shape", "a crescent with two sharp horns"},
       [](Draft& d) { add_shape(d, ShapeFamily::Crescent); }},
      {{"ring", "shape", "a ring: a hole of healthy tissue"}, add_ring},
      {{"border", "shape", "a disk over the tissue's border"}, add_over_border},
  };
}

std::vector<Recipe> several_parts() {
  return {
      {{"two", "parts", "two nodules of 9 mm, 2 mm apart at least"},
       [](Draft& d) { add_nodules(d, 2); }},
      {{"three", "parts", "three of them"}, [](Draft& d) { add_nodules(d, 3); }},
      {{"weak-second", "parts", "two nodules, one of them of 30 to 70 % of the contrast"},
       [](Draft& d) {
         add_nodules(d, 2);
         d.world.design.lumps.back().contrast = d.between(0.3, 0.7);
       }},
      {{"touching", "parts", "two lobes that touch, one of them of 45 to 80 % of the contrast"},
       [](Draft& d) { add_touching(d, d.between(0.45, 0.8)); }},
      {{"core", "parts", "a nodule in a softer rim of 45 to 80 % of its contrast"},
       [](Draft& d) { add_cored(d, d.between(0.45, 0.8)); }},
  };
}

std::vector<Recipe> profiles() {
  return {
      {{"dome", "profile", "a disk with a domed top"},
       [](Draft& d) { add_disk(d, 0.005, 0.008).profile = Profile::Dome; }},
      {{"cone", "profile", "a cone: no plateau on either side"},
       [](Draft& d) { add_disk(d, 0.004, 0.007).profile = Profile::Cone; }},
      {{"gauss", "profile", "a bell"},
       [](Draft& d) { add_disk(d, 0.004, 0.007).profile = Profile::Gauss; }},
      {{"hill", "profile", "what is felt above a buried sphere"},
       [](Draft& d) { add_disk(d, 0.004, 0.007).profile = Profile::Hill; }},
      {{"unequal-slopes", "profile", "a blob, steeper on one side than on the other"},
       [](Draft& d) {
         Lump& lump = add_blob(d);
         lump.steeper = d.between(1.3, 2.0);
         lump.steep_towards = d.direction();
       }},
  };
}

std::vector<Recipe> backgrounds() {
  return {
      {{"vessel", "background", "no tumour: a vessel of 30 % of a tumour's contrast"},
       [](Draft& d) { add_vessel(d, 0.3); }},
      {{"wave", "background", "no tumour: a slow wave of 30 %"},
       [](Draft& d) { add_wave(d, 0.3); }},
      {{"texture", "background", "a blob in tissue whose texture is 7 % of the contrast"},
       [](Draft& d) {
         add_blob(d);
         d.world.design.background.push_back(
             Texture{.sd = 0.07, .length_m = d.between(0.002, 0.005), .seed = d.random.bits()});
       }},
      {{"vessel-beside", "background", "a blob, and a vessel of 30 %"},
       [](Draft& d) {
         add_blob(d);
         add_vessel(d, 0.3);
       }},
      {{"wave-beside", "background", "a blob on a slow wave of 30 %"},
       [](Draft& d) {
         add_blob(d);
         add_wave(d, 0.3);
       }},
      {{"tilt", "background", "no tumour: tissue that slopes by 30 to 150 %"}, add_tilt},
      {{"tilt-beside", "background", "a blob on tissue that slopes by 30 to 150 %"},
       [](Draft& d) {
         add_blob(d);
         add_tilt(d);
       }},
  };
}

std::vector<Recipe> sensors() {
  return {
      {{"drift", "sensor", "a blob, and a zero that drifts by 30 % in a hundred readings"},
       [](Draft& d) {
         add_blob(d);
         d.world.faults.drift = d.between(-0.3, 0.3);
       }},
      {{"lost", "sensor", "a blob; 2 to 12 % of the readings lost contact"},
       [](Draft& d) {
         add_blob(d);
         d.world.faults.lost = d.between(0.02, 0.12);
       }},
      {{"wild", "sensor", "a blob; 1 to 5 % of the readings may be anything"},
       [](Draft& d) {
         add_blob(d);
         d.world.faults.wild = d.between(0.01, 0.05);
         d.world.faults.wild_ranges = std::pow(10.0, d.between(0.0, 2.0));
       }},
      {{"jammed", "sensor", "a blob; 2 to 5 % of the readings repeat the one before"},
       [](Draft& d) {
         add_blob(d);
         d.world.faults.jammed = d.between(0.02, 0.05);
       }},
      {{"sensor-shift", "sensor", "a blob; the zero moves by 25 to 100 % while one looks"},
       [](Draft& d) {
         add_blob(d);
         d.world.change = {.after_stops = kChangeAfter, .zero = d.between(0.25, 1.0)};
       }},
      {{"gain-shift", "sensor", "a blob; the gain changes by up to a half while one looks"},
       [](Draft& d) {
         add_blob(d);
         d.world.change = {.after_stops = kChangeAfter, .gain = d.between(0.5, 1.5)};
       }},
      {{"tissue-moves", "sensor", "a blob; the tissue moves by 2 to 5 mm while one looks"},
       [](Draft& d) {
         add_blob(d);
         const double far_m = d.between(0.002, 0.005);
         d.world.change = {.after_stops = kChangeAfter, .moved_m = far_m * d.direction()};
       }},
      {{"tissue-breathes", "sensor", "a blob; the tissue goes to and fro by 1 to 3 mm"},
       [](Draft& d) {
         add_blob(d);
         const double far_m = d.between(0.001, 0.003);
         d.world.faults.breath = {.by_m = far_m * d.direction(),
                                  .readings = std::exp(d.between(std::log(3.0), std::log(60.0))),
                                  .phase = d.between(0.0, 2.0 * std::numbers::pi)};
       }},
  };
}

const std::vector<Recipe>& recipes() {
  static const std::vector<Recipe> all = [] {
    std::vector<Recipe> together;
    for (const auto& kind : {shapes(), several_parts(), profiles(), backgrounds(), sensors()})
      together.insert(together.end(), kind.begin(), kind.end());
    together.push_back({{"healthy", "healthy", "nothing but noise"}, [](Draft&) {}});
    return together;
  }();
  return all;
}

}  // namespace

std::span<const WorldFamily> world_families() {
  static const std::vector<WorldFamily> families = [] {
    std::vector<WorldFamily> names;
    for (const Recipe& recipe : recipes()) names.push_back(recipe.family);
    return names;
  }();
  return families;
}

DrawnWorld draw_world(const std::string& family, Random& random, const WorldArea& area,
                      const StiffnessModel& model) {
  const auto recipe =
      std::ranges::find(recipes(), family, [](const Recipe& one) { return one.family.name; });
  require(recipe != recipes().end(), "draw_world", "\"" + family + "\"",
          "must be one of world_families()");
  Draft draft{random, area};
  draft.world.design.model = model;
  draft.world.design.model.slope_per_m = draft.between(kLeastSlope_per_m, kMostSlope_per_m);
  recipe->draw(draft);
  move(draft.world.design, area.corner_m);
  return std::move(draft.world);
}

}  // namespace palpation
